//! Alpha: the share of a pixel that polygons cover, and what the pixel's colour then means.

/// What the colour of a partly covered pixel means.
///
/// In both cases alpha is the covered share of the pixel's samples. The choice changes only partly
/// covered pixels. A fully covered pixel has its one colour, and an uncovered pixel has the
/// background's colour and alpha 0. Colours are linear here; they are encoded last.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Alpha {
    /// Straight (unassociated) alpha: the colour is the mean of the covered samples only. [`over`]
    /// puts it over any background. PNG defines alpha this way (ISO/IEC 15948, 4.3.2).
    #[default]
    Straight,
    /// The colour is the mean of all samples, with the background's colour for uncovered ones. Use
    /// it for files without alpha and for pictures that are shown directly.
    Flattened,
}

/// Puts a linear pixel with straight alpha over a linear background: α c + (1 − α) b (*over*,
/// Porter and Duff 1984). All values are in 0..=1.
pub fn over([r, g, b, alpha]: [f64; 4], background: [f64; 3]) -> [f64; 3] {
    let colour = [r, g, b];
    core::array::from_fn(|c| alpha * colour[c] + (1.0 - alpha) * background[c])
}
