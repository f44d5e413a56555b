//! Does the mouse do what the user sees under it?

use carom::{
    app::{Effect, Gesture, Input, Mouse},
    view::ViewSettings,
};
use proptest::{prelude::*, test_runner::RngSeed};

use crate::app::User;

impl User {
    fn mouse(&mut self, gesture: Gesture, column: u16, row: u16) -> Effect {
        let effect = self.app.handle(Input::Mouse(Mouse { gesture, column, row }));
        self.settle();
        effect
    }

    fn click(&mut self, column: u16, row: u16) {
        let _ = self.mouse(Gesture::Press, column, row);
        let _ = self.mouse(Gesture::Release, column, row);
    }

    fn look_at(&self) -> &ViewSettings {
        self.app.view_settings()
    }

    /// The first cell of the side view that shows that text.
    fn cell_of(&self, text: &str) -> (u16, u16) {
        let left = |y: i32| self.row(y)[..40].to_owned();
        let row = (2..22).find(|y| left(*y).contains(text)).unwrap_or_else(|| panic!("{text}\n{}", self.text()));
        let column = left(row).find(text).expect("just found");
        (column as u16, row as u16)
    }
}

#[test]
fn without_being_asked_for_it_does_nothing() {
    let mut user = User::with("paper-2");
    assert_eq!(user.mouse(Gesture::Press, 10, 10), Effect::Nothing);
    assert_eq!(user.mouse(Gesture::Release, 10, 10), Effect::Nothing);
    assert_eq!(user.look_at().selected, None);
    assert!(!user.app.wants_mouse());
}

#[test]
fn a_click_selects_the_sphere_whose_number_is_under_it() {
    let mut user = User::with("paper-2");
    user.type_in("%dddd"); // ids
    for sphere in 0..3 {
        let (column, row) = user.cell_of(&sphere.to_string());
        user.click(column, row);
        assert_eq!(user.look_at().selected, Some(sphere), "{}", user.text());
        assert!(user.text().contains(&format!("Sphere {sphere} is selected")), "{}", user.text());
        user.type_in("\x1b");
    }
}

#[test]
fn a_click_on_the_mark_of_a_contact_shows_its_card() {
    let mut user = User::with("paper-1");
    user.type_in("%c");
    let contact = user.snapshot().contacts[0];
    let (column, row) = user.cell_of("x");
    user.click(column, row);
    assert_eq!(user.look_at().selected, Some(contact.a));
    for word in [format!("#{}", contact.a), format!("wall {}", contact.b), "collides".into(), "N s".into()] {
        assert!(user.text().contains(&word), "{word:?} is not in\n{}", user.text());
    }
    assert!(user.text().contains("Esc closes"), "{}", user.text());
}

#[test]
fn a_drag_moves_the_picture_with_the_pointer_and_selects_nothing() {
    let mut user = User::with("paper-2");
    user.type_in("%dddd");
    let (column, row) = user.cell_of("0");
    let _ = user.mouse(Gesture::Press, column, row);
    assert_eq!(
        user.mouse(Gesture::Drag, column + 5, row + 3),
        Effect::Draw,
        "in its turn: a drag is no flood of pictures"
    );
    let _ = user.mouse(Gesture::Release, column + 5, row + 3);
    assert_eq!(user.cell_of("0"), (column + 5, row + 3), "{}", user.text());
    assert_eq!(user.look_at().selected, None);
    let pan = user.look_at().pan;
    assert_eq!(user.mouse(Gesture::Drag, 1, 1), Effect::Nothing, "the button is not pressed");
    assert_eq!(user.look_at().pan, pan);
}

#[test]
fn the_wheel_zooms_where_the_pointer_is() {
    let mut user = User::with("paper-2");
    user.type_in("%dddd");
    let (column, row) = user.cell_of("0");
    for _ in 0..4 {
        let _ = user.mouse(Gesture::WheelUp, column, row);
    }
    assert!(user.look_at().zoom > 2.0);
    let (x, y) = user.cell_of("0");
    // The number stands in the cell of the sphere's centre, up to half a cell off the pointer: ×2.44 of that.
    assert!(x.abs_diff(column) <= 2 && y.abs_diff(row) <= 2, "{x} {y}, was {column} {row}");
    for _ in 0..4 {
        let _ = user.mouse(Gesture::WheelDown, column, row);
    }
    assert!((user.look_at().zoom - 1.0).abs() < 1e-12 && user.look_at().pan.length() < 1e-9, "{:?}", user.look_at());
}

#[test]
fn press_and_drag_on_the_timeline_go_to_a_time_as_goto_does() {
    let mut user = User::with("paper-0");
    user.type_in("%");
    let _ = user.mouse(Gesture::Press, 30, 22);
    let there = user.snapshot().t;
    assert!((8.0..12.0).contains(&there), "{there}");
    let _ = user.mouse(Gesture::Drag, 35, 2);
    assert!(user.snapshot().t > there, "on by the column, whatever the row");
    let _ = user.mouse(Gesture::Drag, 3, 22);
    assert_eq!(user.snapshot().t, 0.0, "the first column is the start");
    let _ = user.mouse(Gesture::Drag, 79, 22);
    assert_eq!(user.snapshot().t, 0.0, "beside the track there is no time");
}

#[test]
fn over_the_help_and_the_list_the_wheel_moves_and_a_click_does_nothing() {
    let mut user = User::with("paper-0");
    user.type_in("%o");
    let before = user.text();
    user.click(10, 10);
    assert_eq!(user.text(), before);
    let _ = user.mouse(Gesture::WheelDown, 10, 10);
    assert_ne!(user.text(), before);
    let _ = user.mouse(Gesture::WheelUp, 10, 10);
    assert_eq!(user.text(), before);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 40, rng_seed: RngSeed::Fixed(3), failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_row_of_gestures_anywhere_leaves_a_finite_view(gestures in proptest::collection::vec((0_u8..5, 0_u16..100, 0_u16..30, any::<bool>()), 1..60)) {
        let mut user = User::with("paper-2");
        user.type_in("%");
        for (gesture, column, row, far) in gestures {
            let gesture = [Gesture::Press, Gesture::Drag, Gesture::Release, Gesture::WheelUp, Gesture::WheelDown][usize::from(gesture)];
            let (column, row) = if far { (u16::MAX - column, u16::MAX - row) } else { (column, row) };
            // The timeline asks for work of its own.
            if row != 22 {
                let _ = user.app.handle(Input::Mouse(Mouse { gesture, column, row }));
            }
        }
        user.settle();
        prop_assert!(user.look_at().pan.is_finite());
        user.look();
    }
}
