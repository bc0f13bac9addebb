//! Materials: how surfaces reflect light (L21 2.1).

use crate::picture::Rgb;

/// The coefficients of L21 2.1 that say how a surface reflects light, one per colour channel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// Ambient reflection `k_a`.
    pub ambient: Rgb,
    /// Diffuse reflection `k_d`.
    pub diffuse: Rgb,
    /// Specular reflection `k_s`.
    pub specular: Rgb,
    /// The exponent `n`, 0 or more. Large exponents give small, sharp highlights.
    pub shininess: f32,
}

impl Material {
    /// The defaults of MTL files: ambient and diffuse as in J. Burkardt's description of the format
    /// (people.sc.fsu.edu/~jburkardt/data/mtl/mtl.html). The format's own specular 1 and shininess
    /// 0 would light half of the surface white; here there is no highlight instead.
    #[cfg(feature = "io")]
    #[doc(hidden)]
    pub const MTL: Material = Material {
        ambient: [0.2; 3],
        diffuse: [0.8; 3],
        specular: [0.0; 3],
        shininess: 32.0,
    };

    /// A grey surface for lit vertex colours. The coefficients sum to 1, so that colours up to 1 do
    /// not go over 1 under one light of strength 1.
    pub(crate) const NEUTRAL: Material = Material {
        ambient: [0.1; 3],
        diffuse: [0.7; 3],
        specular: [0.2; 3],
        shininess: 32.0,
    };
}

impl Default for Material {
    /// Returns a warm, slightly glossy surface. A mesh without materials and colours gets it.
    fn default() -> Self {
        Material {
            ambient: [0.08, 0.07, 0.06],
            diffuse: [0.60, 0.45, 0.30],
            specular: [0.40, 0.40, 0.40],
            shininess: 32.0,
        }
    }
}
