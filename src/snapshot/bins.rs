//! Bins of equal width over a time from 0 on, whose number is fixed: they double in width when a run outgrows them.

/// The time that bins cover at first, s: `wanted`, or 1 if that is not a positive number.
pub(super) fn span(wanted: f64) -> f64 {
    if wanted.is_finite() && wanted > 0.0 { wanted } else { 1.0 }
}

/// The index of the bin that holds `time` (s, finite). Bins that end before are first joined in pairs, which doubles
/// their `span` (s), until one does; those that come free are `empty`.
pub(super) fn bin<T: Copy>(bins: &mut [T], span: &mut f64, time: f64, empty: T, join: impl Fn(T, T) -> T) -> usize {
    let half = bins.len() / 2;
    while time >= *span && *span < f64::MAX / 2.0 {
        for i in 0..half {
            bins[i] = join(bins[2 * i], bins[2 * i + 1]);
        }
        bins[half..].fill(empty);
        *span *= 2.0;
    }
    let bin = (time.max(0.0) / *span * bins.len() as f64) as usize;
    bin.min(bins.len() - 1)
}
