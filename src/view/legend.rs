//! What the signs on the screen mean, for the help.

use super::glyphs::Glyphs;

/// The signs of a marker, each with what it means.
pub(super) fn signs(glyphs: &Glyphs) -> Vec<(String, &'static str)> {
    let [collides, rests, leaves] = glyphs.contact;
    let [kept, gone, to_come, here] = glyphs.track;
    let (few, many) = (glyphs.levels[0], glyphs.levels[glyphs.levels.len() - 1]);
    let [left, right, up, down] = glyphs.on;
    vec![
        (format!("{collides} {rests} {leaves}"), "a contact's point: it collides, rests, leaves"),
        ("filled ball".into(), "it collides in this frame"),
        ("bar in a ball".into(), "it rests"),
        ("ring around one".into(), "the selected sphere, whose number has a #"),
        ("w6".into(), "the wall of the contact whose card is open"),
        (format!("{left} {right} {up} {down} at a rim"), "a wall goes on beyond the view"),
        (
            "J 5 N s/m top 70".into(),
            "scale of the arrows of impulses (J) and support forces (F); in a crowd only so many, the largest, \
             are drawn, or those at the selected sphere",
        ),
        (format!("{few} {many}"), "timeline: collisions, higher for more"),
        (format!("{here} {kept} {gone} {to_come}"), "timeline: here; frames kept, gone, still to come"),
        ("overlap".into(), "how deep two bodies lie in each other, a part of the radius: the paper's degree"),
        ("ALARM".into(), "bodies overlap, or energy comes out of nowhere"),
    ]
}
