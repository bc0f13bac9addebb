//! Vertex normals: averaged (L21 3.1), given, or averaged up to a crease.

/// Where vertex normals come from.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum NormalSource {
    /// The normalised sum of the unit normals of all polygons around a position (L21 3.1).
    #[default]
    Averaged,
    /// The normals that came with the mesh (by formula or from its file); averaged ones where it has none.
    Given,
    /// As averaged, but only over polygons whose normals differ from this one's by at most so many degrees.
    Crease(f64),
}
