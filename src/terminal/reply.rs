//! What a terminal answers when it is asked.

/// Asks a terminal what it is (primary device attributes): the request that nearly every one answers, in its turn, when
/// all that was sent before is on the screen.
pub(super) const REQUEST: &[u8] = b"\x1b[c";

/// A reply.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Reply {
    /// To [`REQUEST`].
    Attributes,
}

/// The reply that is the control sequence `CSI parameters last`, if it is one.
pub(super) fn reply(parameters: &[u8], last: u8) -> Option<Reply> {
    match (parameters, last) {
        ([b'?', ..], b'c') => Some(Reply::Attributes),
        _ => None,
    }
}
