//! Does a run that goes on from a keyframe equal the run that was never interrupted, bit for bit?

use carom::physics::{Method, Progress, Settings, Simulation, Until};
use carom::random::SplitMix64;
use carom::scene;

/// A frame of these scenes is complete after less.
const WORK: u64 = 1 << 30;

/// Scenes of all kinds: falls, wedges, curved rest, edges, chattering, cells, a gas, and how many frames to look at.
const SCENES: [(&str, u64); 8] = [
    ("paper-0", 2500),
    ("paper-2", 2500),
    ("paper-4", 1500),
    ("zigzag", 1200),
    ("galton", 1500),
    ("newtons-cradle", 1000),
    ("box-gas", 60),
    ("inelastic-666", 40),
];

/// All that can be read of a run at the end of a frame.
fn told(run: &Simulation) -> (u64, String) {
    let told = (run.tallies(), run.step(), run.settings(), run.contacts(), run.probes());
    (run.state().hash(), format!("{told:?}"))
}

/// One frame further; false if the run cannot go on.
fn frame(run: &mut Simulation) -> bool {
    !matches!(run.advance(Until::Frame, WORK), Progress::Stalled(_))
}

#[test]
fn a_run_from_a_keyframe_equals_the_uninterrupted_one() {
    let mut random = SplitMix64::new(1);
    for (name, frames) in SCENES {
        let scene = scene::open(name).expect("built in").scene;
        for &method in Method::ALL {
            let mut run = Simulation::new(&scene, Settings { method, ..scene.solver });
            let mut kept = Vec::new();
            for _ in 0..frames {
                if !frame(&mut run) {
                    break;
                }
                if random.unit() < 20.0 / frames as f64 {
                    kept.push((told(&run), run.keyframe()));
                }
            }
            assert!(!kept.is_empty(), "{name} {method:?}");
            let last = told(&run);
            for (then, keyframe) in kept {
                let mut again = keyframe.run();
                assert_eq!(told(&again), then, "{name} {method:?} at the keyframe itself");
                while again.tallies().frames < run.tallies().frames && frame(&mut again) {}
                assert_eq!(told(&again), last, "{name} {method:?} from t = {} s", keyframe.run().time());
            }
        }
    }
}

#[test]
fn other_settings_from_a_keyframe_on_lead_where_they_lead_from_the_run() {
    let scene = scene::open("paper-4").expect("built in").scene;
    for &method in Method::ALL {
        let mut run = Simulation::new(&scene, Settings { method, ..scene.solver });
        while run.time() < 3.0 && frame(&mut run) {}
        for &next in Method::ALL {
            let other = Settings { method: next, dt: 0.003, tolerance: 1e-5 };
            let (mut on, mut again) = (run.clone(), run.keyframe().run());
            on.set_settings(other);
            again.set_settings(other);
            for _ in 0..200 {
                frame(&mut on);
                frame(&mut again);
            }
            assert_eq!(told(&again), told(&on), "{method:?} to {next:?}");
        }
    }
}
