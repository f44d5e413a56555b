//! Snapshot + view settings → ratatui `Buffer`. No clock, no input, no environment: a frame test builds a snapshot by hand.
//!
//! A caller fills in a [`Screen`] and calls [`draw`](fn@draw). `layout` says what goes where; each part is drawn into its
//! rectangle. The views go another way: `projection` turns metres into dots, `shapes` draws dots on a `canvas`, and the
//! canvas becomes cells. Every string goes through `sheet`, the only place that writes text into the buffer, so that
//! nothing leaves its area and the ASCII marker means ASCII everywhere. Begin with `screen`, then `draw`.
//!
//! | file | owns |
//! |---|---|
//! | `screen` | everything that a frame shows |
//! | `draw` | one frame, each part in its place |
//! | `layout` | what goes where, by the size of the screen |
//! | `sheet`, `glyphs`, `palette`, `ink` | text in cells; its signs and its colours; the user's own colours |
//! | `projection`, `canvas`, `shapes` | metres to dots, dots to cells, lines and circles of dots |
//! | `side` | which way a view looks |
//! | `pane`, `stage`, `overlays` | one view: what it is drawn on, walls and spheres, marks over and under them |
//! | `arrows`, `paths` | impulses and forces to a scale; where spheres were, and where one goes |
//! | `pointing` | what is under a cell: the way back from cells to metres and seconds |
//! | `column`, `inspector`, `sphere`, `probes` | the inspector: its rows, its sections, the selected sphere, the search for the collision time |
//! | `distribution` | how many spheres are how fast, or where: a chart |
//! | `card` | one contact taken apart, in the inspector's place |
//! | `status`, `timeline`, `trade`, `prompt`, `help`, `legend`, `scenes`, `events` | a strip or popup each; what the signs mean |

mod arrows;
mod canvas;
mod card;
mod column;
mod distribution;
mod draw;
mod events;
mod glyphs;
mod help;
mod ink;
mod inspector;
mod layout;
mod legend;
mod overlays;
mod palette;
mod pane;
mod paths;
mod pointing;
mod probes;
mod projection;
mod prompt;
mod scenes;
mod screen;
mod shapes;
mod sheet;
mod side;
mod sphere;
mod stage;
mod status;
mod timeline;
mod trade;

pub use card::order;
pub use draw::{cursor, draw, help_scroll_limit, visible_span};
pub use ink::{Background, Ink, Inks, MOST_TURNS};
pub use layout::inspector_is_shown;
pub use pointing::{Aim, Target, time_at, timeline_row};
pub use screen::{
    CardView, Colors, Comparison, EventsView, Marker, Mode, Overlays, Pace, Popup, Screen, ViewSettings, Views,
};
