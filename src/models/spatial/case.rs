//! An eye in three dimensions, ready to be hit.

use crate::models::axisymmetric::case::{ORBITS_RIM, object, parameters, refused};
use crate::models::axisymmetric::flags::of_blow;
use crate::models::axisymmetric::forces::object::Object;
use crate::models::axisymmetric::time::march::{Steps, Stop};
use crate::models::axisymmetric::{self, eye::parameters::Parameters, time::until::Until};
use crate::models::spatial::eye::{SpatialEye, mesh::Extent, orbit::OrbitRim};
use crate::models::spatial::recording::{results::Extremes, section::Section};
use crate::models::spatial::time::run::{SpatialBlow, run, run_through, step_limit};
use crate::models::spatial::{drawing, forces::object::Aim, readings, rules::RULES};
use crate::run::flags::{Flag, FlagKind};
use crate::run::kept::{Frame, Keep, Spacing};
use crate::run::model::{EyeModel, Run};
use crate::run::plan::Plan;
use crate::run::{drawing::Drawing, places::Region, refusal::Refusal, rules::Rules, watch::Watch};
use crate::run::{raised::Raised, readings::Readings};
use crate::scenario::Integrator;
use crate::scenario::{CheckedScenario, Geometry, Physiological, Projectile, Support};
use std::ops::ControlFlow;
use std::sync::Arc;

/// Energy of flight that breaks bone in half of all cases, in J: of a baseball at 13.9 m/s on the
/// cheekbone, part of which squeezes it; computed walls of orbits break at 16 to 41 J.
const BONE_BREAKS: f64 = 14.0;

/// The longest that a run without a set time lasts, in s.
const LONGEST: f64 = 19e-3;

/// A blow this little out of the plane through the eye's axis is in it, in m.
const IN_PLANE: f64 = 1e-9;

/// A blow on an eye, in SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// What the eye is made of, and what holds it, about its own axis: `axis_angle` is not read.
    pub parameters: Parameters,
    /// The rim of an orbit that was measured; without one what holds the globe is round.
    pub rim: Option<OrbitRim>,
    /// What flies.
    pub object: Object,
    /// How it comes.
    pub aim: Aim,
    /// How long it is followed.
    pub window: Until,
    /// Refinement level, from 1.
    pub level: u32,
    /// How much of the eye is computed; where half of it is not enough, all of it is.
    pub extent: Extent,
}

impl Scene {
    /// What a scenario asks for, whose impact is `projectile`.
    pub fn new(scenario: &CheckedScenario, model: &Physiological, projectile: &Projectile) -> Self {
        // The hour of nothing means nothing: it is 12 then, as for whoever gives none.
        let azimuth =
            |hour: f64, of: f64| if of == 0.0 { 0.0 } else { model.eye_side.azimuth(hour) };
        Self {
            parameters: parameters(model, 0.0),
            rim: (model.support == Support::Orbit).then(|| OrbitRim::from(&model.rim)),
            object: object(projectile),
            aim: Aim {
                angle: projectile.angle_deg.to_radians(),
                from: azimuth(projectile.angle_clock, projectile.angle_deg),
                offset: projectile.offset_mm * 1e-3,
                towards: azimuth(projectile.offset_clock, projectile.offset_mm),
            },
            window: Until::asked(scenario.window_ms, LONGEST),
            level: scenario.eye.level,
            extent: match scenario.geometry() {
                Some(Geometry::Half) => Extent::Half,
                _ => Extent::Full,
            },
        }
    }

    /// How much of the eye it needs: half of it where the blow lies in a plane through the eye's
    /// axis and what holds the globe is round.
    pub fn needs(&self) -> Extent {
        let round = self.parameters.surround.is_none() || self.rim.is_none_or(|rim| rim.is_round());
        if round && self.aim.out_of_plane().abs() < IN_PLANE { Extent::Half } else { Extent::Full }
    }
}

/// An eye in three dimensions, ready to be hit.
#[derive(Debug, Clone)]
pub struct SpatialCase {
    /// The eye.
    pub eye: SpatialEye,
    /// What hits it and how.
    pub blow: SpatialBlow,
    /// Simulated time.
    pub window: Until,
    /// Longest stable step at rest, in s.
    limit: f64,
    /// The rim that was measured.
    measured: Option<OrbitRim>,
}

impl SpatialCase {
    /// Compiles a scene.
    pub fn new(scene: &Scene) -> Self {
        let extent = if scene.needs() == Extent::Half { scene.extent } else { Extent::Full };
        // Half an eye is mirrored about the plane of the blow, which is up in its mesh.
        let up = if extent == Extent::Half { scene.aim.plane() } else { 0.0 };
        let eye = SpatialEye::new(&scene.parameters, scene.rim, extent, scene.level);
        let blow = SpatialBlow { object: scene.object, aim: scene.aim, up };
        let limit = step_limit(&eye, &blow);
        Self { limit, measured: scene.rim, eye, blow, window: scene.window }
    }

    /// Why there is no result.
    fn refused(&self, stop: Stop) -> Refusal {
        // Quads of the cornea are the first that anything goes through.
        let front = self.eye.quads.iter().min_by(|a, b| a.seen.0.total_cmp(&b.seen.0));
        let apart = front.map_or(0.0, |quad| {
            let [a, b, ..] = quad.corners.map(|node| self.eye.mesh.at[node]);
            (b - a).norm()
        });
        refused(stop, Some(&self.blow.object), (self.eye.level, apart))
    }
}

impl EyeModel for SpatialCase {
    fn rules(&self) -> &'static Rules {
        &RULES
    }

    fn window(&self) -> f64 {
        self.window.most()
    }

    fn ends_by_itself(&self) -> bool {
        matches!(self.window, Until::Settled(_))
    }

    fn level(&self) -> u32 {
        self.eye.level
    }

    fn at_level(&self, level: u32) -> Arc<dyn EyeModel> {
        let eye = &self.eye;
        let eye = SpatialEye::new(&eye.parameters, self.measured, eye.extent, level);
        Arc::new(Self { limit: step_limit(&eye, &self.blow), eye, ..self.clone() })
    }

    /// Those of the points of the section, which frames tell of.
    fn regions(&self) -> Vec<Region> {
        let section = Section::new(&self.eye, &self.blow);
        section.points.iter().map(|shown| shown.region).collect()
    }

    fn nodes(&self) -> usize {
        self.eye.mass.len()
    }

    fn elements(&self) -> usize {
        self.eye.cells.len()
    }

    fn step_limit(&self, _: Integrator) -> f64 {
        self.limit
    }

    fn run(&self, plan: &Plan, keep: Keep, watch: Watch) -> Result<Run, Refusal> {
        let steps = Steps::by(plan, self.limit, &RULES)?;
        let window = self.window.within(plan.window);
        let run = run(&self.eye, &self.blow, window, steps, keep, watch);
        let run = run.map_err(|stop| self.refused(stop))?;
        let extremes = run.extremes;
        let mut told = axisymmetric::readings::told(run, &extremes.common);
        readings::over_the_clock(&mut told.readings, &extremes);
        Ok(Run {
            details: readings::details(self, &extremes, told.simulated),
            flags: flags(self, &extremes, &told.readings, told.simulated),
            sectors: Some(extremes.sectors),
            ..told
        })
    }

    fn frames(
        &self,
        plan: &Plan,
        spacing: Spacing,
        take: &mut dyn FnMut(Frame) -> ControlFlow<()>,
    ) -> Result<(), Refusal> {
        let steps = Steps::by(plan, self.limit, &RULES)?;
        let window = self.window.within(plan.window);
        run_through(&self.eye, &self.blow, window, steps, spacing, take)
            .map_err(|stop| self.refused(stop))
    }

    fn drawing(&self) -> Drawing {
        drawing::of(self)
    }
}

/// Flags of a run of `simulated` s.
fn flags(case: &SpatialCase, e: &Extremes, readings: &Readings, simulated: f64) -> Vec<Flag> {
    let mut raised = Raised::default();
    // What holds gelatin stops nothing here.
    let asked = (case.window, None, ORBITS_RIM);
    of_blow(asked, &e.common, (readings, simulated), &mut raised);
    let spent = e.energy_at_bone;
    if spent > BONE_BREAKS {
        let said = format!(
            "the object spent {spent:.0} J at the rim, its own squeezing included; a baseball of \
             {BONE_BREAKS:.0} J breaks a cheekbone in half of all cases; here bone does not break"
        );
        raised.raise(FlagKind::BoneMayBreak, said);
    }
    raised.flags()
}
