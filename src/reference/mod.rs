//! Which picture a method aims at.

/// The closed form that a method's picture is measured against.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Model {
    /// One colour a polygon (L21 2).
    Flat,
    /// Interpolated vertex colours (L21 3).
    Gouraud,
    /// Interpolated, renormalised normals (L21 4.1).
    Phong,
    /// Spherically interpolated normals (L21 4.4).
    Slerp,
}
