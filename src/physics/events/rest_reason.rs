//! Why a contact rests: every reason, with its source and its threshold. The tests are in `rest_criteria`; in `squeezed`
//! for a sphere that just fits between walls, in `islands` for a contact at the point of another, in `initial_contacts` for
//! what touches at load.

/// Why a contact rests.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum RestReason {
    /// The bodies touched at load and neither approached nor parted: v_n = 0.
    Touching,
    /// The bodies approach no faster than `rest_speed`, and are pressed or still approach (the scene's law; source: paper
    /// 2.4).
    Slow,
    /// Pressed, it would be apart for less than ten ulp of the clock: |v_n| ≤ 10 ulp · |a_n|. Restitution acts on the
    /// rounding of such a flight only (Zeno).
    WithinClock,
    /// Pressed, it would hop no higher than 4 ulp of the coordinates: v_n² ≤ 2 |a_n| · 4 ulp.
    WithinCoordinates,
    /// Pressed, with 0 < e < 1, it would hop no higher than 1e-12 r: the rest of its bounces lasts 2 |v_n| e/(1 − e)/|a_n|
    /// in all, and is summed up; the contact holds meanwhile. Of a wall that rubs, the sum also says how far the sphere
    /// slides.
    SeriesSummed,
    /// Pressed, it would hop no higher than 1e-12 r off a wall that takes nothing (e = 1) in a scene that loses energy
    /// elsewhere: without friction it slides like what rests; beside another wall, friction there is its end.
    Undamped,
    /// An impact with e = 0 has just stopped it, and it is pressed: nothing is left to wait for.
    Stopped,
    /// Another wall within 45°, on which the sphere rests, takes back any impulse off this one that would lift it by no more
    /// than coordinates or the clock tell, or, pressed and where something is lossy, by 1e-12 of its radius.
    HeldDown,
    /// More than a hundred small bounces (opening by less than 1e-7 r) in a row, and more than 50/(1 − e), have not died
    /// out by restitution: other contacts feed them. The limit is that all rest together. Of elastic ones, more than a
    /// thousand that coordinates cannot tell from none, or that open by less than 1e-12 r in a scene whose walls rub.
    Chatter,
    /// Inelastic collapse (McNamara, Young, Phys. Fluids A 4, 496, 1992): a chain of more than a thousand events at one
    /// instant whose contacts lose e⁻⁵⁰ of their speed, or come down to its rounding.
    Collapse,
    /// The sphere just fits between walls: the nearest way straight off this one that the others allow leaves it by less
    /// than 64 ulp.
    Squeezed,
    /// The wall shares the point of a resting contact, within 1e-8 r, and neither approaches nor parts beyond rounding: the
    /// tile beyond a seam, the slope beyond a ridge.
    SharedPoint,
    /// The point that it touches, of an edge or a corner, is one of a face that carries the sphere, to 64 ulp: it says no
    /// more than that one, and carries nothing.
    Covered,
}

impl RestReason {
    /// The reason in a few words, as the end of "rests because …".
    pub fn words(self) -> &'static str {
        match self {
            RestReason::Touching => "it touched at the start without approaching",
            RestReason::Slow => "it approaches no faster than rest_speed",
            RestReason::WithinClock => "the clock cannot resolve its next flight",
            RestReason::WithinCoordinates => "coordinates cannot resolve its next hop",
            RestReason::SeriesSummed => "the rest of its bounces is summed up",
            RestReason::Undamped => "its bounces are too low to see, and something else ends them",
            RestReason::Stopped => "an impact without restitution has stopped it",
            RestReason::HeldDown => "a level wall beside it holds the sphere down",
            RestReason::Chatter => "its small bounces do not die out by themselves",
            RestReason::Collapse => "the chain of impacts it belongs to has collapsed",
            RestReason::Squeezed => "the sphere just fits between its walls",
            RestReason::SharedPoint => "it shares the point of a contact that rests",
            RestReason::Covered => "the face of another wall carries the sphere there",
        }
    }
}
