//! Is it said what a run of many spheres costs before it is taken?

use crate::app::User;

#[test]
fn the_exact_run_of_many_spheres_is_taken_when_its_cost_was_told() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("many.ron");
    std::fs::write(
        &path,
        "(spheres: [Lattice(origin: (0, 0, 0), counts: (50, 50, 20), spacing: 1, mass: 1, radius: 0.1)])",
    )
    .expect("a file");
    let mut user = User::with(path.to_str().expect("text"));
    user.type_in("x");
    assert!(user.text().contains("50000 spheres takes about 55 MB"), "{}", user.text());
    assert!(user.app.ghost().is_none() && !user.app.view_settings().ghost);
    user.type_in("ix");
    assert!(!user.app.view_settings().ghost, "another key came between");
    user.type_in("x");
    assert!(user.app.view_settings().ghost && user.app.ghost().is_some());
    user.type_in("x");
    assert!(!user.app.view_settings().ghost);
}
