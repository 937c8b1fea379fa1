use super::*;
use crate::answer::solve::solve;
use crate::run::kept::{Keep, Spacing};
use crate::run::{drawing::Drawing, watch::unwatched};
use crate::scenario::library::{built_in, find};
use crate::scenario::{Geometry, Impact, Scenario};
use crate::tui::{clock::MeshDetail, model::AppModel, shown::ShownAnswer, view::palette::DARK};
use nalgebra::Point2;
use ratatui::buffer::Buffer;

fn answered(scenario: &Scenario) -> ShownAnswer {
    let keep = Keep { traces: true, frames: Some(Spacing::doubling(80, 2.5e-5)) };
    let answer = solve(&scenario.check().unwrap(), keep, &mut unwatched).unwrap();
    ShownAnswer::new(scenario.clone(), answer)
}

fn draw(shown: &ShownAnswer, frame: &Frame, look: Look, (wide, high): (u16, u16)) -> Buffer {
    let mut buffer = Buffer::empty(Rect::new(0, 0, wide, high));
    let model = AppModel { look, ..AppModel::default() };
    let picture = EyePicture::of(&model, shown, frame.time);
    EyePicture { detail: MeshDetail::Anatomy, ..picture }.draw(buffer.area, &mut buffer);
    buffer
}

fn inside(ring: &[Point2<f64>], at: Point2<f64>) -> bool {
    let next = ring.iter().cycle().skip(1);
    let crossed = ring.iter().zip(next).filter(|(a, b)| {
        (a.y > at.y) != (b.y > at.y) && at.x < a.x + (at.y - a.y) / (b.y - a.y) * (b.x - a.x)
    });
    crossed.count() % 2 == 1
}

/// Where no object can be, from the nodes alone: in the globe, its fat, and behind the rim.
fn forbidden(drawing: &Drawing, frame: &Frame) -> Vec<Vec<Point2<f64>>> {
    let places = |nodes: &[usize]| -> Vec<Point2<f64>> {
        nodes.iter().map(|node| drawing.place(frame, *node, 1.0)).collect()
    };
    let lines = &drawing.outlines;
    let mut all = vec![places(&lines.shell)];
    if let (Some(first), Some(last)) = (lines.free[0].last(), lines.free[1].last()) {
        let rest = |node: usize| drawing.at_rest(&drawing.nodes[node]);
        let place = |node: &usize| {
            let apart = |i: &usize| (rest(lines.shell[*i]) - rest(*node)).norm();
            let nodes = 0..lines.shell.len();
            nodes.min_by(|a, b| apart(a).total_cmp(&apart(b))).unwrap()
        };
        let wall = places(&lines.wall);
        let mut fat = [wall.clone(), places(&lines.free[1])].concat();
        fat.extend(places(&lines.shell[place(first)..=place(last)]).iter().rev());
        fat.extend(places(&lines.free[0]).iter().rev());
        all.push(fat);
        let (top, bottom) = (wall[0], wall[wall.len() - 1]);
        let out = (top - bottom).normalize();
        let back = nalgebra::Vector2::new(out.y, -out.x);
        let mut beside = wall;
        beside.extend([bottom - out, bottom - out + back, top + out + back, top + out]);
        all.push(beside);
    }
    all
}

#[test]
fn nothing_of_an_object_is_drawn_behind_the_shell_or_in_the_bone() {
    let of_object = [DARK.object, DARK.skin].map(|role| role.ink().unwrap());
    let spatial = [
        ("soccer-ball", 0.0, 12.0, 0.0),
        ("squash-ball", 40.0, 6.0, 0.0),
        ("squash-ball", 60.0, 3.0, 3.0),
        ("squash-ball", 0.0, 12.0, 8.0),
    ];
    let spatial = spatial.map(|(name, angle, clock, offset)| {
        let mut aside = find(name).unwrap().scenario().unwrap();
        if let Impact::Projectile(object) = &mut aside.impact {
            (object.angle_deg, object.angle_clock, object.offset_mm) = (angle, clock, offset);
        }
        Scenario { window_ms: Some(1.5), ..aside }
    });
    let (mut seen, invisible) = (0, spatial.len());
    let presets = built_in().into_iter().map(|preset| {
        // Sections of both eyes are drawn alike, and those in three dimensions take long.
        let mut scenario = preset.scenario().unwrap();
        if matches!(scenario.impact, Impact::Projectile(_)) {
            scenario.numerics.geometry = Geometry::Axisymmetric;
        }
        scenario
    });
    let fast = presets.filter(|of| of.projectile().is_some() && !of.is_spatial());
    let scenarios: Vec<Scenario> = fast.chain(spatial).collect();
    for scenario in &scenarios {
        let shown = answered(scenario);
        let mut here = 0;
        for frame in shown.answer.run.frames.iter().step_by(4) {
            let forbidden = forbidden(&shown.drawing, frame);
            for size in [(28, 9), (55, 22), (110, 32)] {
                let look = Look::new(Depth::TwoFiveSix, Symbols::Braille);
                let buffer = draw(&shown, frame, look, (size.0, size.1 + 2));
                let (window, field) = Window::within(buffer.area, &shown.drawing, look.symbols);
                for at in field.positions() {
                    let (x, y) = (f64::from(at.x - field.x), f64::from(at.y - field.y));
                    let cell = &buffer[at];
                    let sign = cell.symbol().chars().next().unwrap();
                    let mask = QUADRANTS.iter().position(|s| *s == sign).unwrap_or(0);
                    for point in 0..4 {
                        let color = if mask >> point & 1 == 1 { cell.fg } else { cell.bg };
                        if !of_object.contains(&color) {
                            continue;
                        }
                        here += 1;
                        let x = x + 0.25 + 0.5 * f64::from(point % 2);
                        let y = y + 0.25 + 0.5 * f64::from(point / 2);
                        // A point shows most of what lies in it, and a cell two things at most.
                        let around = [(-0.6, 0.0), (0.6, 0.0), (0.0, -0.6), (0.0, 0.6), (0.0, 0.0)];
                        let around = around.map(|(dx, dy)| window.place((x + dx, y + dy)));
                        for ring in &forbidden {
                            let deep = around.iter().all(|at| inside(ring, *at));
                            let (name, time) = (&scenario.name, frame.time);
                            assert!(!deep, "{name}: {:?} at {time} s", around[4]);
                        }
                    }
                }
            }
        }
        seen += usize::from(here > 0);
    }
    assert!(seen + invisible > scenarios.len(), "{seen} of {}", scenarios.len());
    assert!(scenarios.len() > 10, "{}", scenarios.len());
}

#[test]
fn the_object_is_round_again_when_it_leaves_and_flat_where_it_presses() {
    let shown = answered(&find("squash-ball").unwrap().scenario().unwrap());
    let width = |frame: &Frame| {
        let mut sides = crate::report::picture::object_sides(&shown.drawing, frame);
        sides.sort_by(|[a, _], [b, _]| a.x.total_cmp(&b.x));
        sides[sides.len() - 1][0].x - sides[0][0].x
    };
    let frames = &shown.answer.run.frames;
    let apex = shown.answer.peak(crate::run::quantity::Quantity::Apex).unwrap().time;
    let deepest = &frames[crate::run::kept::nearest(frames, apex)];
    assert!((width(&frames[0]) - 40e-3).abs() < 0.5e-3, "{}", width(&frames[0]));
    assert!(width(deepest) < 20e-3, "{}", width(deepest));
    let last = frames.last().unwrap();
    assert!((width(last) - 40e-3).abs() < 0.5e-3, "{}", width(last));
}

/// Rows of signs, and below them a letter for each pair of colours.
fn text(buffer: &Buffer) -> String {
    let mut styles = Vec::new();
    let (mut signs, mut letters) = (String::new(), String::new());
    for row in buffer.content.chunks(buffer.area.width.into()) {
        for cell in row {
            signs += cell.symbol();
            let style = (cell.fg, cell.bg);
            if !styles.contains(&style) {
                styles.push(style);
            }
            let place = styles.iter().position(|s| *s == style).unwrap() as u8;
            let plain = style == (Color::Reset, Color::Reset);
            letters.push(char::from(if plain { b' ' } else { b'!' + place % 94 }));
        }
        signs.push('\n');
        letters.push('\n');
    }
    if styles.len() > 1 { format!("{signs}\n{letters}") } else { signs }
}

#[test]
fn every_number_of_colours_has_its_own_form() {
    let shown = answered(&find("squash-ball").unwrap().scenario().unwrap());
    let frames = &shown.answer.run.frames;
    let apex = shown.answer.peak(crate::run::quantity::Quantity::Apex).unwrap().time;
    let deepest = &frames[crate::run::kept::nearest(frames, apex)];
    for (name, depth, symbols, size) in [
        ("256", Depth::TwoFiveSix, Symbols::Braille, (55, 24)),
        ("16", Depth::Sixteen, Symbols::Braille, (55, 24)),
        ("mono", Depth::Mono, Symbols::Braille, (55, 24)),
        ("octants", Depth::Mono, Symbols::Octant, (55, 24)),
        ("blocks", Depth::Mono, Symbols::Block, (55, 24)),
        ("ascii", Depth::Mono, Symbols::Ascii, (55, 24)),
        ("ascii_small", Depth::Mono, Symbols::Ascii, (28, 11)),
    ] {
        let mut buffer = draw(&shown, deepest, Look::new(depth, symbols), size);
        if symbols == Symbols::Ascii {
            crate::tui::view::text::to_ascii(&mut buffer);
        }
        let mut settings = insta::Settings::clone_current();
        settings.set_snapshot_path("../../../../tests/app/snapshots");
        settings.set_prepend_module_to_snapshot(false);
        settings.set_omit_expression(true);
        settings.bind(|| insta::assert_snapshot!(format!("anatomy_{name}"), text(&buffer)));
    }
}
