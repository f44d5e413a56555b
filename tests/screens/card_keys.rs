//! Do the keys of a contact's card, of its trial steps and of the message line do what they should?

use carom::app::{Action, Key, Keymap};

use super::app::User;

#[test]
fn the_card_of_a_contact_opens_moves_and_closes_and_the_inspector_can_be_hidden() {
    let mut user = User::with("paper-0");
    user.type_in("c\n");
    assert!(user.text().contains("1 of 1") && user.text().contains("collides"), "{}", user.text());
    user.type_in(".");
    assert!(user.text().contains("contact"), "it stays open while one steps\n{}", user.text());
    user.type_in("\x1b");
    assert!(!user.text().contains("Esc closes"), "{}", user.text());
    let shown = |user: &User| (user.text().contains("sphere #0"), user.text().contains("Esc closes"));
    let mut seen = Vec::new();
    for _ in 0..3 {
        user.type_in("i");
        seen.push(shown(&user));
    }
    assert_eq!(seen, [(true, false), (false, true), (false, false)], "numbers, card, off");
}

#[test]
fn the_trial_steps_of_a_search_are_gone_through_with_the_views() {
    let mut user = User::with("paper-0");
    user.type_in("(");
    assert!(user.text().contains("searched for no collision time"), "{}", user.text());
    user.type_in("c\x1b");
    let (at_end, trials) = (user.screen.clone(), user.snapshot().trials.clone());
    assert_eq!(trials.len(), user.snapshot().probes.len());
    user.type_in(")");
    assert!(user.text().contains(&format!("trial step 1 of {}", trials.len())), "{}", user.text());
    let first = user.snapshot().at_trial(0).expect("it is kept");
    assert!(first.x == trials[0] && first.t > user.snapshot().t, "the first trial step is a whole frame");
    for _ in &trials {
        user.type_in(")");
    }
    assert!(!user.text().contains("trial step 1 of"), "past the last one the frame's end is shown\n{}", user.text());
    user.type_in("\x1b");
    assert_eq!(user.screen, at_end);
}

#[test]
fn what_happens_unasked_hides_no_answer_and_the_next_key_ends_both() {
    let mut user = User::with("paper-0");
    user.type_in(":hash\n");
    user.app.tell("The line was silent for 1.0 s; 3 frames were skipped.");
    user.app.tell("The line was silent for 2.0 s; 9 frames were skipped.");
    user.look();
    let message = format!("{} {}", user.row(-2).trim(), user.row(-1).trim());
    assert!(
        message.contains("hash=") && message.contains("for 2.0 s; 9 frames") && !message.contains("1.0 s"),
        "{message}"
    );
    user.type_in("\x1b");
    assert!(!user.text().contains("hash=") && !user.text().contains("silent"), "{}", user.text());
}

#[test]
fn messages_name_keys_as_they_are_bound() {
    let mut keymap = Keymap::default();
    keymap.bind(Action::NextImpact, &[Key::char('Y')]);
    keymap.bind(Action::Until, &[Key::char('!')]);
    let mut user = User::bound("paper-0", true, keymap);
    user.type_in("(");
    assert!(user.text().contains("Y goes to a collision"), "{}", user.text());
    user.type_in("U");
    assert!(user.text().contains("! asks until what to run"), "{}", user.text());
}

#[test]
fn an_impulse_of_paper_is_shown_in_the_frame_over_which_it_acts_however_one_comes_there() {
    let mut user = User::with("paper-1"); // a sphere of 1 kg under 9.8 m/s², sliding down a slope
    user.type_in("c");
    let (contact, before) = (user.snapshot().contacts[0], user.snapshot().v[0]);
    assert!(user.snapshot().acting.is_empty(), "nothing was struck the frame before");
    user.type_in(".w");
    let acting = user.snapshot().acting.clone();
    assert_eq!((acting.len(), acting[0].key(), acting[0].impulse), (1, contact.key(), contact.impulse));
    let step = user.snapshot().step;
    let gained = user.snapshot().v[0] - before - user.snapshot().stage.gravity * step;
    // the mass is 1 kg; gravity's part is taken off by a subtraction: rounding. Along the wall it is rubbed as well.
    assert!((gained.dot(contact.normal) - contact.impulse).abs() < 1e-12, "{gained}");
    let text = user.text();
    assert!(text.contains("contact  none in this frame") && text.contains("acts"), "{text}");
    let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
    for word in ["3.1223 N", "0.01 s", "312.23 N"] {
        assert!(words.contains(word), "{word}: {text}");
    }
    let frame = user.snapshot().tallies.frames;
    for keys in [",.", "...,,,", ":goto 5\n:goto 0.23\n", "gG:goto 0.1\n:goto 0.23\n"] {
        user.type_in(keys);
        assert_eq!((user.snapshot().tallies.frames, &user.snapshot().acting), (frame, &acting), "{keys}");
    }
    user.type_in("g:method exact\nc.");
    assert!(user.snapshot().acting.is_empty(), "exact answers at once");
}
