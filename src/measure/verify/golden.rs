//! Golden hashes: the bits that every build on every machine makes.

use super::check::Check;
use super::runner::{Row, Runner, Trouble};
use crate::physics::Simulation;
use crate::scene::{self, Method, Settings};

/// A run and the hash of its end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Golden {
    /// Name of a built-in scene.
    pub scene: &'static str,
    /// End of the run, s.
    pub until: f64,
    /// What solves it, in frames of 0.01 s at most and with a tolerance of 1e-3.
    pub method: Method,
    /// [`State::hash`](crate::physics::State::hash) of the state then.
    pub hash: u64,
}

/// What must never differ between machines and optimisation levels. A change of the arithmetic on purpose enters it
/// anew, from the message of the test that fails.
pub const GOLDEN: &[Golden] = &[
    golden("paper-0", 12.0, Method::Exact, 0x60c7bd27f7b5f1ce),
    golden("paper-1", 8.0, Method::Exact, 0xf72bbe578d8916bc),
    golden("paper-2", 10.0, Method::Exact, 0x95e8bac0aac6399b),
    golden("paper-3", 8.0, Method::Exact, 0x95621590005945a8),
    golden("paper-4", 5.0, Method::Exact, 0x85d65e5db8904d3d),
    golden("zeno", 10.0, Method::Exact, 0x82fb254f7e1943ac),
    golden("corner", 5.0, Method::Exact, 0x7e68ee05e762b5b2),
    golden("newtons-cradle", 20.0, Method::Exact, 0xb11436696990f1fd),
    golden("paper-0", 12.0, Method::Paper, 0x1bd190d4d0ebd010),
    golden("paper-1", 8.0, Method::Paper, 0xdd7d795d15911912),
    golden("paper-2", 10.0, Method::Paper, 0x008eeb07a92d2862),
    golden("paper-3", 8.0, Method::Paper, 0x971ee35912911934),
    golden("paper-4", 5.0, Method::Paper, 0x6b2e8fda467cfcfd),
    golden("zeno", 10.0, Method::Paper, 0xb8af2fe4bdf32a64),
    golden("corner", 5.0, Method::Paper, 0x7c76e6a0e19ddf14),
    golden("newtons-cradle", 20.0, Method::Paper, 0x96ddd5673680961a),
    golden("paper-0", 12.0, Method::Swept, 0xa137e8ff3e90a52b),
    golden("paper-1", 8.0, Method::Swept, 0xd65c6e882ce647c2),
    golden("paper-2", 10.0, Method::Swept, 0x14be6d86d2855e19),
    golden("paper-3", 8.0, Method::Swept, 0x78fd894993a8725b),
    golden("paper-4", 5.0, Method::Swept, 0x891ed0e123a75235),
    golden("zeno", 10.0, Method::Swept, 0x493bf24071c0e98d),
    golden("corner", 5.0, Method::Swept, 0xf742273ff871bae0),
    golden("newtons-cradle", 20.0, Method::Swept, 0xf497d6449d8523b6),
];

pub(super) const CHECK: Check = Check {
    title: "golden hashes",
    source: "runs of built-in scenes end with the same bits as where Carom is made",
    allowed: "none: bit for bit",
    measure,
};

const fn golden(scene: &'static str, until: f64, method: Method, hash: u64) -> Golden {
    Golden { scene, until, method, hash }
}

impl Golden {
    /// The hash that this build makes.
    ///
    /// # Errors
    /// If the scene is not known or the run stalls: a full sentence.
    pub fn found(&self, runner: &Runner) -> Result<u64, Trouble> {
        let opened = scene::open(self.scene)?;
        let settings = Settings { method: self.method, dt: 0.01, tolerance: 1e-3 };
        Ok(runner.go(&mut Simulation::new(&opened.scene, settings), self.until)?.hash())
    }
}

fn measure(runner: &Runner) -> Result<Vec<Row>, Trouble> {
    let mut methods: Vec<Method> = GOLDEN.iter().map(|golden| golden.method).collect();
    methods.dedup();
    methods.into_iter().map(|method| equal(runner, method)).collect()
}

/// How many runs of a method end with the bits of old.
fn equal(runner: &Runner, method: Method) -> Result<Row, Trouble> {
    let (mut runs, mut same) = (0, 0);
    for golden in GOLDEN.iter().filter(|golden| golden.method == method) {
        runs += 1;
        same += u32::from(golden.found(runner)? == golden.hash);
    }
    Ok(Row::new(format!("golden hashes, {}", method.name()), "", [f64::from(runs), f64::from(same)], 0.0))
}
