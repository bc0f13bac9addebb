//! Alpha: the covered share of a pixel, and what its colour then means.

/// The colour of a pixel of which polygons cover some samples and not others.
///
/// Alpha is the covered share of the samples either way. Pixels that are covered as a whole have one colour either way, and
/// those that nothing covers have the background's, with alpha 0. Encoding comes last: colours are linear here.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Alpha {
    /// Straight alpha, not associated: the mean of the covered samples alone. [`over`] puts it over any background. This is what
    /// PNG means by alpha (ISO/IEC 15948, 4.3.2).
    #[default]
    Straight,
    /// The mean of all samples, where the background stands for those that nothing covers: for files without alpha, and to
    /// be looked at as it is.
    Flattened,
}

/// Returns the colour of a linear pixel of straight alpha over a linear background: α c + (1 − α) b (Porter and Duff 1984, *over*).
pub fn over([r, g, b, alpha]: [f64; 4], background: [f64; 3]) -> [f64; 3] {
    let colour = [r, g, b];
    core::array::from_fn(|c| alpha * colour[c] + (1.0 - alpha) * background[c])
}
