//! What a key can do.

/// What a key can do. How it is called, and by which keys, is the business of the key table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Action {
    /// Pause, or run.
    TogglePause,
    /// One frame further.
    Step,
    /// One frame back.
    StepBack,
    /// Ten frames further.
    TenOn,
    /// Ten frames back.
    TenBack,
    /// On to the next frame with an impact.
    NextImpact,
    /// Back to the frame with the impact before.
    PreviousImpact,
    /// Back to the first frame that is kept.
    Oldest,
    /// On to the newest frame.
    Newest,
    /// Type what to run until.
    Until,
    /// Run until it comes again.
    UntilAgain,
    /// Back to t = 0.
    Restart,
    /// Read the scene's file again.
    Reload,
    /// The scene before this one in the list.
    PreviousScene,
    /// The scene after this one in the list.
    NextScene,
    /// Open the list of scenes, or close it.
    Scenes,
    /// Tolerance ÷ 10.
    LowerTolerance,
    /// Tolerance × 10.
    RaiseTolerance,
    /// dt ÷ 2.
    HalveDt,
    /// dt × 2.
    DoubleDt,
    /// The next method from here on.
    NextMethod,
    /// Speed × 2.
    Faster,
    /// Speed ÷ 2.
    Slower,
    /// One simulated second per second.
    RealTime,
    /// Both views, side, top.
    NextViews,
    /// Move the view.
    Pan(Direction),
    /// Zoom in.
    ZoomIn,
    /// Zoom out.
    ZoomOut,
    /// The whole scene, as at first.
    WholeScene,
    /// Keep the selected sphere in the centre, or stop.
    Follow,
    /// Select the next sphere.
    SelectNext,
    /// Select the sphere before.
    SelectPrevious,
    /// Show the inspector, or hide it.
    Inspector,
    /// Take a contact of the frame apart, or close its card.
    Card,
    /// List all that has happened, or close the list.
    Events,
    /// Show the trial step before in the views.
    PreviousTrial,
    /// Show the next trial step in the views.
    NextTrial,
    /// The next set of overlays.
    NextOverlays,
    /// Show where the exact run is now, or stop.
    Ghost,
    /// Write the picture and the state into files.
    TakeAway,
    /// Record the run from here on, or write the recording into a file.
    Record,
    /// Type exact values.
    Prompt,
    /// Show the keys, or hide them.
    Help,
    /// Have the terminal report the mouse, or leave it to the terminal.
    Mouse,
    /// Draw everything again.
    Repaint,
    /// Give the terminal back to the shell for a while.
    Suspend,
    /// End the program.
    Quit,
    /// Close what is open.
    Close,
}

impl Action {
    /// Name of the action in a configuration: `step`, `pan_left`.
    pub fn name(self) -> String {
        let mut name = String::new();
        for c in format!("{self:?}").chars().filter(|c| *c != ')') {
            match c {
                '(' => {}
                c if c.is_ascii_uppercase() => {
                    name.extend((!name.is_empty()).then_some('_'));
                    name.push(c.to_ascii_lowercase());
                }
                c => name.push(c),
            }
        }
        name
    }
}

/// Where the view moves to on the screen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Direction {
    /// Left: −x.
    Left,
    /// Down the screen: −y seen from the side, +z from the top.
    Down,
    /// Up the screen: +y seen from the side, −z from the top.
    Up,
    /// Right: +x.
    Right,
}
