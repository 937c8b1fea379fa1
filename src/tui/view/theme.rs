//! The roles that colours play, for each number of colours.
//!
//! Palettes are made by hand: the sixteen are those that stay legible on dark and light grounds
//! (bright black and blue do not), and heat has as many steps as can be told apart. Without colours
//! bold, dim, underline and reverse do the work. Of the 256 every role has a contrast of 4.5 at least, on
//! black and on the bar. Left out: a palette of 256 for light grounds, where `--color 16` is the better choice.

use ratatui::style::{Color, Modifier, Style};

use super::heat::HeatMap;
use crate::eye::Region;
use crate::injury::gravity;
use crate::tui::model::Look;
use crate::tui::terminal::caps::Depth;

/// Styles by role.
#[derive(Debug, Clone, Copy)]
pub struct Theme {
    depth: Depth,
    heat: HeatMap,
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
/// Of the same map, what can be read on black.
const HOT_256: [u8; 7] = [196, 202, 208, 214, 220, 228, 231];
/// The upper half of cividis (Nunez, Anderton and Renslow 2018, doi:10.1371/journal.pone.0199239): the nearest of
/// the 256 in even steps of lightness.
const CIVIDIS_256: [u8; 5] = [243, 246, 144, 185, 227];

/// How grave something is, from harmless on, for index and risk alike.
const GRAVE_16: [Color; 4] = [
    Color::LightGreen,
    Color::LightYellow,
    Color::LightRed,
    Color::LightRed,
];
const GRAVE_256: [u8; 4] = [114, 221, 209, 203];

impl Theme {
    /// The theme of a look.
    pub fn of(look: Look) -> Self {
        Self {
            depth: look.depth,
            heat: look.heat,
        }
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

    /// Laid over a result of what was there before the last edit.
    pub fn stale(self) -> Style {
        Style::new().add_modifier(DIM).remove_modifier(BOLD)
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
            // The bar is reversed, so this is not.
            _ => Style::new().remove_modifier(REVERSED).add_modifier(BOLD),
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

    /// One of four steps from harmless to grave.
    fn grave(self, step: usize) -> Style {
        let step = step.min(GRAVE_256.len() - 1);
        let mono = Style::new();
        let style = self.pick(mono, GRAVE_16[step], Color::Indexed(GRAVE_256[step]));
        match step {
            0 | 1 => style,
            2 if self.depth != Depth::Mono => style,
            _ => style.add_modifier(BOLD),
        }
    }

    /// Something that is so many times its limit.
    pub fn gauge(self, share: f64) -> Style {
        self.grave(
            [0.5, 1.0, 2.0]
                .iter()
                .take_while(|limit| share >= **limit)
                .count(),
        )
    }

    /// A risk from 0 to 1, by the words of the verdicts.
    pub fn risk(self, risk: f64) -> Style {
        self.grave(gravity(risk))
    }

    /// How many steps of heat there are above cold.
    pub fn heat_steps(self) -> usize {
        match (self.depth, self.heat) {
            (Depth::Sixteen, _) => HOT_16.len(),
            (Depth::TwoFiveSix, HeatMap::Cividis) => CIVIDIS_256.len(),
            (Depth::Mono | Depth::TwoFiveSix, _) => HOT_256.len(),
        }
    }

    /// A step of heat; 0 is cold.
    pub fn heat(self, step: usize) -> Style {
        let Some(step) = step.checked_sub(1) else {
            return self.quiet();
        };
        let step = step.min(self.heat_steps() - 1);
        match (self.depth, self.heat) {
            (Depth::Mono, _) if step + 2 < HOT_256.len() => Style::new(),
            (Depth::Mono, _) => Style::new().add_modifier(BOLD),
            (Depth::Sixteen, _) => Style::new().fg(HOT_16[step]),
            (Depth::TwoFiveSix, HeatMap::Hot) => Style::new().fg(Color::Indexed(HOT_256[step])),
            (Depth::TwoFiveSix, HeatMap::Cividis) => {
                Style::new().fg(Color::Indexed(CIVIDIS_256[step]))
            }
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tui::terminal::caps::Symbols;

    /// The contrast that text needs (WCAG 2.1, 1.4.3).
    const READABLE: f64 = 4.5;

    fn theme(depth: Depth, heat: HeatMap) -> Theme {
        Theme::of(Look {
            depth,
            symbols: Symbols::Braille,
            heat,
        })
    }

    /// Red, green and blue of one of the 256 colours, from 0 to 1.
    fn rgb(color: Color) -> [f64; 3] {
        let Color::Indexed(index) = color else {
            panic!("{color:?} is none of the 256");
        };
        let level = |step: u8| {
            if step == 0 {
                0.0
            } else {
                f64::from(55 + 40 * u32::from(step))
            }
        };
        let bytes = match index {
            16..=231 => {
                let cube = index - 16;
                [cube / 36, cube / 6 % 6, cube % 6].map(level)
            }
            232.. => [f64::from(8 + 10 * u32::from(index - 232)); 3],
            _ => panic!("{index} depends on the terminal"),
        };
        bytes.map(|byte| byte / 255.0)
    }

    /// Relative luminance as WCAG has it.
    fn luminance(color: Color) -> f64 {
        let linear = |c: f64| {
            if c <= 0.040_45 {
                c / 12.92
            } else {
                ((c + 0.055) / 1.055).powf(2.4)
            }
        };
        let [red, green, blue] = rgb(color).map(linear);
        0.2126 * red + 0.7152 * green + 0.0722 * blue
    }

    fn contrast(a: Color, b: Color) -> f64 {
        let (a, b) = (luminance(a), luminance(b));
        (a.max(b) + 0.05) / (a.min(b) + 0.05)
    }

    #[test]
    fn every_role_can_be_read_on_its_ground() {
        for heat in [HeatMap::Hot, HeatMap::Cividis] {
            let theme = theme(Depth::TwoFiveSix, heat);
            let black = Color::Indexed(16);
            let mut roles = vec![
                theme.text(),
                theme.quiet(),
                theme.heading(),
                theme.strong(),
                theme.warning(),
                theme.error(),
                theme.bar(),
                theme.bar_strong(),
                theme.bar_chosen(),
                theme.load(),
                theme.cursor(),
            ];
            roles.extend((0..6).map(|i| theme.curve(i)));
            roles.extend((0..4).map(|step| theme.grave(step)));
            roles.extend((0..=theme.heat_steps()).map(|step| theme.heat(step)));
            let regions = [
                Region::Interior,
                Region::Lens,
                Region::Shell,
                Region::Retina,
                Region::Fat,
                Region::Orbit,
            ];
            roles.extend(regions.map(|region| theme.region(region)));
            for role in roles {
                // What has no colour of its own is the terminal's.
                let Some(ink) = role.fg else { continue };
                let ratio = contrast(ink, role.bg.unwrap_or(black));
                assert!(ratio >= READABLE, "{role:?}: {ratio:.2}");
            }
        }
    }

    #[test]
    fn the_even_map_goes_up_in_even_steps_of_lightness() {
        let theme = theme(Depth::TwoFiveSix, HeatMap::Cividis);
        let lightness = |step| {
            let ink = theme.heat(step).fg.unwrap();
            116.0 * luminance(ink).cbrt() - 16.0
        };
        let steps: Vec<f64> = (2..=theme.heat_steps())
            .map(|step| lightness(step) - lightness(step - 1))
            .collect();
        let most = steps.iter().copied().fold(0.0, f64::max);
        let least = steps.iter().copied().fold(f64::INFINITY, f64::min);
        assert!(least > 5.0 && most < 1.5 * least, "{steps:?}");
    }

    #[test]
    fn what_is_chosen_in_a_bar_stands_out_without_colours() {
        for depth in [Depth::Mono, Depth::Sixteen] {
            let theme = theme(depth, HeatMap::Hot);
            let chosen = theme.bar().patch(theme.bar_chosen());
            assert!(theme.bar().add_modifier.contains(REVERSED));
            assert!(!chosen.add_modifier.contains(REVERSED));
        }
    }
}
