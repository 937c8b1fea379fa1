//! How each role looks: its colour from the [palette](crate::tui::view::palette), bold where it
//! must stand out, and without colours bold, dim, underline and reverse alone.

use ratatui::style::{Color, Style};

use crate::injury::{Risk, Share, gravity};
use crate::report::picture::Part;
use crate::run::places::Region;
use crate::tui::view::palette::{Colour, Colours, FIELD, FIELD_16, ink};
use crate::tui::{look::Look, terminal::caps::Depth};

/// Styles by role.
#[derive(Debug, Clone, Copy)]
pub struct Theme {
    /// How things are drawn.
    pub look: Look,
    colours: Colours,
}

const PLAIN: Style = Style::new();
const BOLD: Style = Style::new().bold();
const DIM: Style = Style::new().dim();

impl Theme {
    /// The theme of a look.
    pub fn of(look: Look) -> Self {
        Self { look, colours: look.palette.colours(look.depth) }
    }

    /// Whether there are no colours.
    pub fn is_mono(self) -> bool {
        self.look.depth == Depth::Mono
    }

    /// Plain text.
    pub fn text(self) -> Style {
        PLAIN
    }

    /// Text of less weight.
    pub fn quiet(self) -> Style {
        // Over a curve it must not take the curve's colour.
        pick(self.colours.quiet, DIM.fg(Color::Reset))
    }

    /// Laid over a result of what was there before the last edit.
    pub fn stale(self) -> Style {
        DIM.not_bold()
    }

    /// A heading.
    pub fn heading(self) -> Style {
        pick(self.colours.heading, PLAIN).bold()
    }

    /// A value that matters.
    pub fn strong(self) -> Style {
        BOLD
    }

    /// What has the focus.
    pub fn focus(self) -> Style {
        PLAIN.reversed()
    }

    /// Something to beware of.
    pub fn warning(self) -> Style {
        pick(self.colours.warning, PLAIN).bold()
    }

    /// Something wrong.
    pub fn error(self) -> Style {
        pick(self.colours.error, PLAIN.underlined()).bold()
    }

    /// The bar at the top and the bottom.
    pub fn bar(self) -> Style {
        on(self.colours.bar, self.colours.bar_ground).unwrap_or(PLAIN.reversed())
    }

    /// What is chosen in a bar.
    pub fn bar_chosen(self) -> Style {
        // Where the bar is reversed this is not.
        on(self.colours.chosen, self.colours.chosen_ground).unwrap_or(PLAIN).not_reversed().bold()
    }

    /// The load and its arc.
    pub fn load(self) -> Style {
        pick(self.colours.load, BOLD)
    }

    /// The mark of the present moment.
    pub fn cursor(self) -> Style {
        pick(self.colours.cursor, BOLD)
    }

    /// One of several curves.
    pub fn curve(self, index: usize) -> Style {
        let of = self.colours;
        let curves = [of.curve_1, of.curve_2, of.curve_3, of.curve_4, of.curve_5, of.curve_6];
        pick(curves[index % curves.len()], [PLAIN, BOLD, DIM][index % 3])
    }

    /// The one ladder of risk, by the places of its words: green is what is not expected.
    fn grave(self, step: usize) -> Style {
        let of = self.colours;
        let steps = [of.harmless, of.mild, of.serious, of.grave];
        let step = step.min(steps.len() - 1);
        let style = pick(steps[step], PLAIN);
        let is_bold = step == 3 || step == 2 && self.is_mono();
        if is_bold { style.bold() } else { style }
    }

    /// A bar of what is no risk.
    pub fn filled(self) -> Style {
        pick(self.colours.heading, PLAIN)
    }

    /// A risk as its word goes; quiet where nothing is known, which is not harmless.
    pub fn risk(self, risk: &Risk) -> Style {
        let is_told = risk.usable && !risk.is_open();
        if is_told { self.grave(risk.gravity()) } else { self.quiet() }
    }

    /// A share of eyes with its range.
    pub fn share(self, share: &Share) -> Style {
        self.grave(gravity(share))
    }

    /// A risk from 0 to 1 of which no upper end is known: never harmless.
    pub fn told(self, risk: f64) -> Style {
        self.share(&Share { told: risk, low: risk, high: 1.0 })
    }

    /// The colours of heat; without colours the steps are told by glyphs and bold.
    fn heats(self) -> &'static [u8] {
        self.look.palette.heat(self.look.heat, self.look.depth)
    }

    /// How many steps of heat there are above cold.
    pub fn heat_steps(self) -> usize {
        self.heats().len()
    }

    /// A step of heat; 0 is cold.
    pub fn heat(self, step: usize) -> Style {
        let most = self.heat_steps();
        match step {
            0 => self.quiet(),
            _ if !self.is_mono() => PLAIN.fg(ink(self.heats()[step.min(most) - 1])),
            _ if step + 1 < most => PLAIN,
            _ => BOLD,
        }
    }

    /// A part of a filled picture; of the globe by the step of its field.
    pub fn part(self, part: Part, step: usize) -> Color {
        let of = self.colours;
        let role = match part {
            Part::Sky => return Color::Reset,
            // Black on light grounds too.
            Part::Pupil => return ink(if self.look.depth == Depth::TwoFiveSix { 16 } else { 0 }),
            Part::Globe if self.is_mono() => return Color::Reset,
            Part::Globe if self.look.depth == Depth::TwoFiveSix => return ink(FIELD[step]),
            Part::Globe => return ink(FIELD_16[step * FIELD_16.len() / FIELD.len()]),
            Part::Object | Part::Veil => of.object,
            Part::Skin => of.skin,
            Part::Fat => of.fat_ground,
            Part::Bone => of.bone,
            Part::Nerve => of.nerve,
            Part::Ciliary | Part::Limbus => of.ciliary,
            Part::Lens => of.lens,
            Part::Iris => of.iris,
            Part::Retina => of.retina,
            Part::Sclera => of.sclera,
            Part::Cornea => of.cornea,
            Part::Pressed => of.pressed,
        };
        role.ink().unwrap_or(Color::Reset)
    }

    /// The dots of the fat.
    pub fn fat_dots(self) -> Style {
        pick(self.colours.fat, self.quiet())
    }

    /// The dots of an outline at rest, on a part.
    pub fn ghost(self, on: Part) -> Color {
        let (many, few) = match on {
            Part::Object | Part::Skin => (16, 0),
            Part::Sky | Part::Fat => (246, 8),
            _ => (250, 7),
        };
        ink(if self.look.depth == Depth::TwoFiveSix { many } else { few })
    }

    /// A part of the eye that is cold.
    pub fn region(self, region: Region) -> Style {
        match region {
            Region::Interior => pick(self.colours.interior, DIM),
            Region::Lens => pick(self.colours.lens, PLAIN),
            Region::Shell => pick(self.colours.shell, PLAIN),
            Region::Retina => pick(self.colours.retina, BOLD),
            Region::Fat => pick(self.colours.fat, DIM),
            Region::Orbit => pick(self.colours.orbit, PLAIN),
        }
    }
}

/// A role's colour, or else another style.
fn pick(role: Colour, otherwise: Style) -> Style {
    role.ink().map_or(otherwise, Style::from)
}

/// A colour on another; none where there are none.
fn on(role: Colour, ground: Colour) -> Option<Style> {
    Some(PLAIN.fg(role.ink()?).bg(ground.ink()?))
}

#[cfg(test)]
mod tests {
    use super::*;
    use ratatui::style::Modifier;

    use crate::tui::{terminal::caps::Symbols, view::heat::HeatMap};

    /// The contrast that text needs (WCAG 2.1, 1.4.3).
    const READABLE: f64 = 4.5;

    fn theme(depth: Depth, heat: HeatMap, light: bool) -> Theme {
        let mut look = Look::new(depth, Symbols::Braille);
        (look.heat, look.palette.light) = (heat, light);
        Theme::of(look)
    }

    /// Red, green and blue of one of the 256 colours, from 0 to 1.
    fn rgb(color: Color) -> [f64; 3] {
        let Color::Indexed(index) = color else { panic!("{color:?} is none of the 256") };
        let level = |step: u8| if step == 0 { 0.0 } else { 55.0 + 40.0 * f64::from(step) };
        assert!(index >= 16, "{index} depends on the terminal");
        let bytes = match index - 16 {
            cube @ ..216 => [cube / 36, cube / 6 % 6, cube % 6].map(level),
            grey => [8.0 + 10.0 * f64::from(grey - 216); 3],
        };
        bytes.map(|byte| byte / 255.0)
    }

    /// Relative luminance as WCAG has it.
    fn luminance(color: Color) -> f64 {
        let curve = |c: f64| ((c + 0.055) / 1.055).powf(2.4);
        let linear = |c: f64| if c <= 0.040_45 { c / 12.92 } else { curve(c) };
        let [red, green, blue] = rgb(color).map(linear);
        0.2126 * red + 0.7152 * green + 0.0722 * blue
    }

    fn contrast(a: Color, b: Color) -> f64 {
        let (a, b) = (luminance(a), luminance(b));
        (a.max(b) + 0.05) / (a.min(b) + 0.05)
    }

    #[test]
    fn every_role_can_be_read_on_dark_and_on_light_grounds() {
        use Region::{Fat, Interior, Lens, Orbit, Retina, Shell};
        let grounds = [(false, 16), (true, 231), (true, 255)];
        let maps = [HeatMap::Hot, HeatMap::Cividis];
        for ((light, ground), heat) in grounds.iter().flat_map(|g| maps.map(|map| (*g, map))) {
            let theme = theme(Depth::TwoFiveSix, heat, light);
            let ground = Color::Indexed(ground);
            let mut roles = vec![theme.text(), theme.quiet(), theme.heading(), theme.strong()];
            roles.extend([theme.warning(), theme.error(), theme.load(), theme.cursor()]);
            roles.extend([theme.bar(), theme.bar().bold(), theme.bar_chosen()]);
            roles.extend((0..6).map(|i| theme.curve(i)));
            roles.extend((0..4).map(|step| theme.grave(step)));
            roles.extend((0..=theme.heat_steps()).map(|step| theme.heat(step)));
            let regions = [Interior, Lens, Shell, Retina, Fat, Orbit];
            roles.extend(regions.map(|region| theme.region(region)));
            for role in roles {
                // What has no colour of its own is the terminal's.
                let Some(ink) = role.fg else { continue };
                let ratio = contrast(ink, role.bg.unwrap_or(ground));
                assert!(ratio >= READABLE, "{role:?} on {ground:?}: {ratio:.2}");
            }
        }
    }

    /// CIE L*, a* and b* of one of the 256 colours in daylight (D65).
    fn lab(color: Color) -> [f64; 3] {
        let curve = |c: f64| ((c + 0.055) / 1.055).powf(2.4);
        let linear = |c: f64| if c <= 0.040_45 { c / 12.92 } else { curve(c) };
        let [r, g, b] = rgb(color).map(linear);
        let x = (0.4124 * r + 0.3576 * g + 0.1805 * b) / 0.9505;
        let y = 0.2126 * r + 0.7152 * g + 0.0722 * b;
        let z = (0.0193 * r + 0.1192 * g + 0.9505 * b) / 1.089;
        let f = |t: f64| if t > 0.008_856 { t.cbrt() } else { 7.787 * t + 16.0 / 116.0 };
        let [x, y, z] = [x, y, z].map(f);
        [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
    }

    /// How far two colours lie apart; 2.3 is just seen (CIE 1976).
    fn apart(a: Color, b: Color) -> f64 {
        let squared = lab(a).into_iter().zip(lab(b)).map(|(a, b)| (a - b) * (a - b));
        squared.sum::<f64>().sqrt()
    }

    #[test]
    fn steps_of_risk_are_told_apart_and_nothing_else_has_their_colours() {
        for light in [false, true] {
            let theme = theme(Depth::TwoFiveSix, HeatMap::Hot, light);
            let ladder: Vec<Color> = (0..4).filter_map(|step| theme.grave(step).fg).collect();
            assert_eq!(ladder.len(), 4);
            for (i, step) in ladder.iter().enumerate() {
                for other in &ladder[..i] {
                    assert!(apart(*step, *other) > 25.0, "{step:?} {other:?}");
                }
                let mut others = vec![theme.heading(), theme.warning(), theme.error()];
                others.extend([theme.load(), theme.cursor(), theme.quiet()]);
                others.extend((0..6).map(|i| theme.curve(i)));
                let others = others.into_iter().filter_map(|style| style.fg);
                let parts = [Part::Object, Part::Skin, Part::Pressed, Part::Retina, Part::Cornea];
                for other in others.chain(parts.map(|part| theme.part(part, 0))) {
                    let far = apart(*step, other);
                    assert!(far > 20.0, "{step:?} and {other:?}, light {light}: {far:.0}");
                }
            }
        }
    }

    #[test]
    fn curves_and_neighbours_of_the_picture_are_told_apart() {
        for light in [false, true] {
            let theme = theme(Depth::TwoFiveSix, HeatMap::Hot, light);
            let curves: Vec<Color> = (0..6).filter_map(|i| theme.curve(i).fg).collect();
            for (i, curve) in curves.iter().enumerate() {
                for other in &curves[..i] {
                    let far = apart(*curve, *other);
                    assert!(far > 20.0, "{curve:?} and {other:?}, light {light}: {far:.0}");
                }
            }
            for (a, b) in [
                (Part::Object, Part::Cornea),
                (Part::Object, Part::Pressed),
                (Part::Object, Part::Skin),
                (Part::Object, Part::Bone),
                (Part::Pressed, Part::Cornea),
                (Part::Pressed, Part::Sclera),
                (Part::Retina, Part::Sclera),
                (Part::Iris, Part::Lens),
                (Part::Bone, Part::Fat),
            ] {
                let far = apart(theme.part(a, 0), theme.part(b, 0));
                assert!(far > 15.0, "{a:?} beside {b:?}, light {light}: {far:.0}");
            }
        }
    }

    #[test]
    fn sixteen_colours_keep_the_ladder_the_warnings_and_the_object_apart() {
        let theme = theme(Depth::Sixteen, HeatMap::Hot, false);
        let mut seen: Vec<Option<Color>> = (0..4).map(|step| theme.grave(step).fg).collect();
        seen.extend([theme.warning().fg, theme.heading().fg, theme.curve(0).fg]);
        seen.extend([Some(theme.part(Part::Object, 0)), Some(theme.part(Part::Cornea, 0))]);
        for (i, colour) in seen.iter().enumerate() {
            let cornea_is_the_first_curve = i == seen.len() - 1;
            let same = seen[..i].iter().any(|other| other == colour);
            assert!(!same || cornea_is_the_first_curve, "{colour:?} of {seen:?}");
        }
    }

    #[test]
    fn the_even_map_leaves_the_ground_in_even_steps_of_lightness() {
        for light in [false, true] {
            let theme = theme(Depth::TwoFiveSix, HeatMap::Cividis, light);
            let lightness = |place: u8| 116.0 * luminance(ink(place)).cbrt() - 16.0;
            let sign = if light { -1.0 } else { 1.0 };
            let step = |two: &[u8]| sign * (lightness(two[1]) - lightness(two[0]));
            let mut steps: Vec<f64> = theme.heats().windows(2).map(step).collect();
            steps.sort_by(f64::total_cmp);
            let (least, most) = (steps[0], steps[steps.len() - 1]);
            assert!(least > 5.0 && most < 1.5 * least, "{steps:?}");
        }
    }

    #[test]
    fn what_is_chosen_in_a_bar_stands_out_without_colours() {
        for depth in [Depth::Mono, Depth::Sixteen] {
            let theme = theme(depth, HeatMap::Hot, false);
            let is_reversed = |style: Style| style.add_modifier.contains(Modifier::REVERSED);
            assert!(is_reversed(theme.bar()));
            assert!(!is_reversed(theme.bar().patch(theme.bar_chosen())));
        }
    }
}
