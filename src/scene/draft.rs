//! Scenes built in code: drafts, and scenes that follow from others.

use glam::DVec3;

use super::error::{Error, Source};
use super::number::Finite;
use super::rules::{self, default_view};
use super::validated::{Draft, Resume, Scene, Settings, Sphere, Wall};
use super::values;

/// What refusals call a scene that has no file.
const ORIGIN: Source = Source { text: "", origin: "a scene built in code" };

impl Draft {
    /// A draft of these bodies with everything else as in a scene file that says nothing of it: no gravity, the contact
    /// law and the settings of the source paper, 20 s, and a view of all bodies.
    pub fn new(walls: Vec<Wall>, spheres: Vec<Sphere>) -> Draft {
        Draft {
            name: "scene".into(),
            about: String::new(),
            gravity: DVec3::ZERO,
            contact: rules::contact_law(&Default::default()),
            solver: rules::settings(&Default::default()),
            duration: rules::DURATION,
            view: default_view(&walls, &spheres),
            resume: None,
            walls,
            spheres,
        }
    }

    /// The scene, if the draft meets every rule that a scene file must meet.
    ///
    /// # Errors
    /// The first rule that it breaks.
    pub fn validated(self) -> Result<Scene, Error> {
        rules::checked(self, ORIGIN)
    }
}

impl Scene {
    /// The scene after a change of it. One that goes on from a run begins anew there, at its time.
    ///
    /// # Errors
    /// The first rule that is broken then.
    pub fn changed(&self, change: impl FnOnce(&mut Draft)) -> Result<Scene, Error> {
        let mut draft = self.begun_anew();
        change(&mut draft);
        draft.validated()
    }

    /// The scene with its spheres at these centres (m) with these velocities (m/s), by index, as a run has left them.
    /// They may overlap, and be far away, as the spheres of a run may; every other rule is met. A scene that goes on from a
    /// run begins anew there, at its time.
    ///
    /// # Errors
    /// If a number is not finite.
    pub fn moved(&self, x: &[DVec3], v: &[DVec3]) -> Result<Scene, Error> {
        let mut draft = self.begun_anew();
        for (sphere, (x, v)) in draft.spheres.iter_mut().zip(x.iter().zip(v)) {
            (sphere.x, sphere.v) = (*x, *v);
        }
        values::refuse_places::<Finite>(&draft.spheres, ORIGIN)?;
        Ok(Scene::sealed(draft))
    }

    /// The scene from which a run by these settings goes on where one has left the spheres, at these centres (m) with these
    /// velocities (m/s).
    ///
    /// # Errors
    /// If a number is not finite.
    pub fn going_on(&self, settings: Settings, resume: Resume, x: &[DVec3], v: &[DVec3]) -> Result<Scene, Error> {
        let Scene(mut draft) = self.moved(x, v)?;
        // past the scene's own end there is as much to come again
        if draft.duration <= resume.t {
            draft.duration += resume.t;
        }
        (draft.solver, draft.resume) = (settings, Some(resume));
        Ok(Scene::sealed(draft))
    }

    /// A draft of the scene without what held only of the spheres where they are.
    fn begun_anew(&self) -> Draft {
        let resume = self.resume.as_ref().map(|resume| Resume { t: resume.t, transient: Vec::new() });
        Draft { resume, ..Draft::clone(self) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Parallelogram;

    fn sphere(x: DVec3) -> Sphere {
        Sphere { x, v: DVec3::ZERO, mass: 1.0, radius: 0.5, force: DVec3::ZERO, color: None, name: None }
    }

    fn refusal(change: impl FnOnce(&mut Draft)) -> String {
        let floor = Wall { shape: Parallelogram { center: DVec3::ZERO, s1: DVec3::X, s2: DVec3::Z }, color: None };
        let mut draft = Draft::new(vec![floor], vec![sphere(DVec3::Y), sphere(DVec3::Y * 2.0)]);
        assert!(draft.clone().validated().is_ok(), "it is the change that breaks a rule");
        change(&mut draft);
        draft.validated().map_or_else(|error| error.to_string(), |_| String::from("nothing"))
    }

    #[test]
    fn a_draft_must_meet_the_rules_of_a_file() {
        let said = [
            refusal(|draft| draft.spheres[1].mass = -1.0),
            refusal(|draft| draft.spheres[1].x = DVec3::new(0.0, f64::NAN, 0.0)),
            refusal(|draft| draft.spheres[1].x = DVec3::Y * 1.5),
            refusal(|draft| draft.spheres[0].x = DVec3::Y * 0.25),
            refusal(|draft| draft.walls[0].shape.s2 = DVec3::X),
            refusal(|draft| draft.contact.restitution = 1.5),
            refusal(|draft| draft.solver.dt = 0.0),
            refusal(|draft| draft.duration = f64::INFINITY),
            refusal(|draft| draft.gravity.z = 1e31),
            refusal(|draft| draft.view.max = draft.view.min),
            refusal(|draft| draft.name = "\u{1b}[31m".into()),
            refusal(|draft| draft.spheres[0].color = Some([0.0, 2.0, 0.0])),
        ];
        let places = [
            "spheres[1].mass: -1 is refused",
            "spheres[1].x[1]: NaN is refused",
            "spheres[1]: sphere 0 (spheres[0]) overlaps sphere 1 (spheres[1])",
            "spheres[0]: sphere 0 (spheres[0]) overlaps wall 0",
            "walls[0]: s1 and s2 are parallel",
            "contact.restitution: 1.5 is refused",
            "solver.dt: 0 is refused",
            "duration: inf is refused",
            "gravity[2]: ",
            "view: along x, min",
            "name: the character U+001B",
            "spheres[0].color[1]: 2 is refused",
        ];
        for (said, place) in said.iter().zip(places) {
            assert!(said.starts_with(&format!("a scene built in code: {place}")), "{said}");
        }
    }

    #[test]
    fn what_a_run_has_moved_may_overlap_but_must_be_numbers() {
        let scene =
            Draft::new(Vec::new(), vec![sphere(DVec3::ZERO), sphere(DVec3::X)]).validated().expect("they touch");
        let still = [DVec3::ZERO; 2];
        let closer = scene.moved(&[DVec3::ZERO, DVec3::X * 0.999], &still).expect("a run may do so");
        assert_eq!(closer.spheres[1].x, DVec3::X * 0.999);
        assert!(scene.moved(&[DVec3::ZERO, DVec3::NAN], &still).is_err());
        assert!(closer.changed(|draft| draft.duration = 1.0).is_err(), "a start of its own may not overlap");
    }
}
