//! How linear values are stored in eight bits.

/// round(255 c), clamped; halves go up, NaN gives 0.
#[inline(always)]
pub fn quantise(c: f32) -> u8 {
    // The conversion saturates: values under 0 give 0, values over 255 give 255, NaN gives 0.
    (c * 255.0 + 0.5) as u8
}

/// A linear texel as it is stored.
pub fn store(texel: [f32; 4], encoding: crate::scene::Encoding) -> [u8; 4] {
    let _ = encoding;
    texel.map(quantise)
}
