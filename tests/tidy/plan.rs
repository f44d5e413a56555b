//! The plan of the house: which module may name which, where outside crates live, and the bounds of every file.

/// Which module may name which: exactly the arrows that the product draws.
pub(crate) const PLAN: &[(&str, &[&str])] = &[
    ("main", &["cli"]),
    (
        "cli",
        &[
            "app",
            "audit",
            "certify",
            "config",
            "explain",
            "export",
            "format",
            "frame",
            "marks",
            "measure",
            "physics",
            "printable",
            "recording",
            "scene",
            "snapshot",
            "terminal",
            "text_mode",
            "view",
        ],
    ),
    ("terminal", &["app", "frame", "printable", "recording", "scene", "view"]),
    ("config", &["app", "format", "printable", "scene", "view"]),
    (
        "app",
        &["format", "frame", "geometry", "physics", "printable", "recording", "scene", "snapshot", "view", "worker"],
    ),
    ("explain", &["format", "snapshot"]),
    ("recording", &["physics", "scene"]),
    ("worker", &["audit", "measure", "physics", "recording", "scene", "snapshot"]),
    ("view", &["explain", "format", "snapshot"]),
    ("frame", &["printable"]),
    ("measure", &["certify", "export", "format", "geometry", "physics", "printable", "random", "scene"]),
    ("marks", &["certify", "export", "format", "geometry", "measure", "physics", "printable", "scene"]),
    ("certify", &["double", "physics", "scene"]),
    ("text_mode", &["audit", "format", "physics", "scene"]),
    ("export", &["physics", "printable"]),
    ("audit", &["physics"]),
    ("snapshot", &["audit", "geometry", "physics", "printable", "scene"]),
    ("physics", &["double", "geometry", "roots", "scene"]),
    ("scene", &["format", "geometry", "printable", "random"]),
    ("double", &[]),
    ("geometry", &[]),
    ("roots", &[]),
    ("random", &[]),
    ("format", &[]),
    ("printable", &[]),
];

/// The methods: rooms of the physics that only `simulation` may name, which holds one of them.
pub(crate) const METHODS: &[&str] = &["paper", "swept", "exact", "moreau"];

/// Which crates live where only.
pub(crate) const HOMES: &[(&str, &[&str])] = &[
    ("crossterm", &["terminal"]),
    ("signal_hook", &["terminal", "cli"]),
    ("tui_input", &["app"]),
    ("ron", &["scene"]),
    ("serde_path_to_error", &["scene"]),
    ("serde", &["scene", "config", "export"]),
    ("serde_json", &["export"]),
    ("csv", &["export"]),
    ("clap", &["cli"]),
    ("etcetera", &["config"]),
    ("clap_complete", &["cli"]),
    ("clap_mangen", &["cli"]),
    ("indicatif", &["cli"]),
    ("unicode_properties", &["printable"]),
];

/// Parts of the standard library by which the outer world would enter.
pub(crate) const OUTER_WORLD: &[&str] = &["time", "thread", "fs", "io", "net", "process", "env", "os", "random"];

/// Modules that see nothing but their arguments.
pub(crate) const BLIND: &[&str] =
    &["physics", "geometry", "roots", "random", "format", "audit", "certify", "snapshot", "view"];

/// What the judge may know of the physics: what a run tells, never how it was found.
pub(crate) const TOLD: &[&str] = &[
    "Class",
    "Contact",
    "Kind",
    "Method",
    "Model",
    "Settings",
    "Simulation",
    "State",
    "Tallies",
    "contact",
    "model",
    "wall::Face",
];

/// What only a mathematical library computes: its last bit differs from machine to machine.
pub(crate) const INEXACT: &[&str] = &[
    "sin",
    "cos",
    "tan",
    "sin_cos",
    "asin",
    "acos",
    "atan",
    "atan2",
    "sinh",
    "cosh",
    "tanh",
    "exp",
    "exp2",
    "exp_m1",
    "ln",
    "ln_1p",
    "log2",
    "log10",
    "powf",
    "powi",
    "cbrt",
    "hypot",
    "mul_add",
    "angle_between",
    "slerp",
    "to_radians",
];

/// What may stand in no product file.
pub(crate) const UNFINISHED: &[&str] =
    &["unwrap", "todo!", "unimplemented!", "dbg!", "println!", "eprintln!", "print!", "eprint!"];

/// Files that may be longer than [`FILE`], and why.
pub(crate) const LONG_FILES: &[(&str, &str)] = &[];

/// What the physics takes from the scene, and has one address there.
pub(crate) const OF_THE_SCENE: &[&str] = &["ContactLaw", "Method", "Scene", "Settings"];

/// Lines of the longest file, of the longest function; arguments of a function beside `self`.
pub(crate) const FILE: usize = 500;
pub(crate) const FUNCTION: usize = 50;
pub(crate) const ARGUMENTS: usize = 5;
