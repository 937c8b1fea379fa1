//! The roles that colours play, for each number of colours.
//!
//! Palettes are made by hand: the sixteen are those that stay legible on dark and light grounds
//! (bright black and blue do not), and heat has as many steps as can be told apart. Without colours
//! bold, dim, underline and reverse do the work.

use ratatui::style::{Color, Modifier, Style};

use crate::eye::Region;
use crate::tui::model::Look;
use crate::tui::terminal::caps::Depth;

/// Styles by role.
#[derive(Debug, Clone, Copy)]
pub struct Theme {
    depth: Depth,
}

const BOLD: Modifier = Modifier::BOLD;
const DIM: Modifier = Modifier::DIM;
const REVERSED: Modifier = Modifier::REVERSED;

/// The paper's HOT map from dark red to white.
const HOT_16: [Color; 5] = [
    Color::Red,
    Color::LightRed,
    Color::Yellow,
    Color::LightYellow,
    Color::White,
];
const HOT_256: [Color; 7] = [
    Color::Indexed(88),
    Color::Indexed(124),
    Color::Indexed(196),
    Color::Indexed(202),
    Color::Indexed(214),
    Color::Indexed(226),
    Color::Indexed(231),
];

impl Theme {
    /// The theme of a look.
    pub fn of(look: Look) -> Self {
        Self { depth: look.depth }
    }

    fn pick(self, mono: Style, sixteen: Color, many: Color) -> Style {
        match self.depth {
            Depth::Mono => mono,
            Depth::Sixteen => Style::new().fg(sixteen),
            Depth::TwoFiveSix => Style::new().fg(many),
        }
    }

    /// Whether there are no colours.
    pub fn is_mono(self) -> bool {
        self.depth == Depth::Mono
    }

    /// Plain text.
    pub fn text(self) -> Style {
        Style::new()
    }

    /// Text of less weight.
    pub fn quiet(self) -> Style {
        match self.depth {
            Depth::TwoFiveSix => Style::new().fg(Color::Indexed(246)),
            _ => Style::new().add_modifier(DIM),
        }
    }

    /// A heading.
    pub fn heading(self) -> Style {
        self.pick(Style::new(), Color::Cyan, Color::Indexed(80))
            .add_modifier(BOLD)
    }

    /// A value that matters.
    pub fn strong(self) -> Style {
        Style::new().add_modifier(BOLD)
    }

    /// What has the focus.
    pub fn focus(self) -> Style {
        Style::new().add_modifier(REVERSED)
    }

    /// Something to beware of.
    pub fn warning(self) -> Style {
        self.pick(Style::new(), Color::LightYellow, Color::Indexed(221))
            .add_modifier(BOLD)
    }

    /// Something wrong.
    pub fn error(self) -> Style {
        let mono = Style::new().add_modifier(Modifier::UNDERLINED);
        self.pick(mono, Color::LightRed, Color::Indexed(203))
            .add_modifier(BOLD)
    }

    /// The bar at the top and the bottom.
    pub fn bar(self) -> Style {
        match self.depth {
            Depth::TwoFiveSix => Style::new().fg(Color::Indexed(252)).bg(Color::Indexed(236)),
            _ => Style::new().add_modifier(REVERSED),
        }
    }

    /// Something strong in a bar.
    pub fn bar_strong(self) -> Style {
        self.bar().add_modifier(BOLD)
    }

    /// What is chosen in a bar.
    pub fn bar_chosen(self) -> Style {
        match self.depth {
            Depth::TwoFiveSix => Style::new()
                .fg(Color::Indexed(16))
                .bg(Color::Indexed(80))
                .add_modifier(BOLD),
            _ => Style::new().add_modifier(BOLD),
        }
    }

    /// A frame round something, or an axis.
    pub fn line(self) -> Style {
        self.quiet()
    }

    /// The load and its arc.
    pub fn load(self) -> Style {
        let mono = Style::new().add_modifier(BOLD);
        self.pick(mono, Color::LightGreen, Color::Indexed(84))
    }

    /// The mark of the present moment.
    pub fn cursor(self) -> Style {
        let mono = Style::new().add_modifier(BOLD);
        self.pick(mono, Color::LightCyan, Color::Indexed(123))
    }

    /// One of several curves.
    pub fn curve(self, index: usize) -> Style {
        let sixteen = [
            Color::LightCyan,
            Color::LightYellow,
            Color::LightMagenta,
            Color::LightGreen,
            Color::LightRed,
            Color::White,
        ];
        let many = [80, 221, 176, 114, 209, 254];
        let mono = match index % 3 {
            0 => Style::new(),
            1 => Style::new().add_modifier(BOLD),
            _ => Style::new().add_modifier(DIM),
        };
        let i = index % sixteen.len();
        self.pick(mono, sixteen[i], Color::Indexed(many[i]))
    }

    /// Share of a gauge that is filled: below, near and above its threshold.
    pub fn gauge(self, share: f64) -> Style {
        if share < 0.5 {
            self.pick(Style::new(), Color::LightGreen, Color::Indexed(114))
        } else if share < 1.0 {
            self.pick(Style::new(), Color::LightYellow, Color::Indexed(221))
        } else {
            self.pick(
                Style::new().add_modifier(BOLD),
                Color::LightRed,
                Color::Indexed(203),
            )
        }
    }

    /// How many steps of heat there are above cold.
    pub fn heat_steps(self) -> usize {
        match self.depth {
            Depth::Mono | Depth::TwoFiveSix => HOT_256.len(),
            Depth::Sixteen => HOT_16.len(),
        }
    }

    /// A step of heat; 0 is cold.
    pub fn heat(self, step: usize) -> Style {
        let Some(step) = step.checked_sub(1) else {
            return self.quiet();
        };
        match self.depth {
            Depth::Mono if step + 2 < HOT_256.len() => Style::new(),
            Depth::Mono => Style::new().add_modifier(BOLD),
            Depth::Sixteen => Style::new().fg(HOT_16[step.min(HOT_16.len() - 1)]),
            Depth::TwoFiveSix => Style::new().fg(HOT_256[step.min(HOT_256.len() - 1)]),
        }
    }

    /// A part of the eye that is cold.
    pub fn region(self, region: Region) -> Style {
        let dim = Style::new().add_modifier(DIM);
        match region {
            Region::Interior => self.pick(dim, Color::Gray, Color::Indexed(243)),
            Region::Lens => self.pick(Style::new(), Color::LightCyan, Color::Indexed(117)),
            Region::Shell => self.pick(Style::new(), Color::Gray, Color::Indexed(252)),
            Region::Retina => self.pick(
                Style::new().add_modifier(BOLD),
                Color::LightMagenta,
                Color::Indexed(176),
            ),
            // Dark yellow is a step of heat already.
            Region::Fat if self.depth == Depth::Sixteen => dim,
            // Brown beside dark red would be one colour.
            Region::Fat => self.pick(dim, Color::Reset, Color::Indexed(101)),
            Region::Orbit => self.pick(Style::new(), Color::Green, Color::Indexed(108)),
        }
    }
}
