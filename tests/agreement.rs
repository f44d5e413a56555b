//! What each method does in the source paper's scenes.

mod support;

use carom::physics::{Progress, Simulation, Until};
use support::{paper, paper_scene};

#[test]
fn table() {
    for dt in [0.01, 0.001] {
        for tol in [1e-3, 1e-2] {
            for k in 0..5 {
                let mut run = Simulation::new(&paper_scene(k), paper(dt, tol));
                run.record_events(true);
                let p = run.advance(Until::Time(20.0), 1_000_000_00);
                let s = match p {
                    Progress::Stalled(s) => format!("{} {} {}", s.time, s.kind, s.reason),
                    p => format!("{p:?}"),
                };
                let t = run.tallies();
                let last = run
                    .take_events()
                    .iter()
                    .filter(|e| e.class == carom::physics::Class::Collide)
                    .last()
                    .map(|e| e.time);
                println!(
                    "dt {dt} tol {tol} scene {k}: t {} E {} {:?} last {:?} {}",
                    run.time(),
                    run.energy(),
                    t,
                    last,
                    s
                );
            }
        }
    }
}
