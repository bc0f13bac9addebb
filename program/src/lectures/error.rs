//! The error of a figure that cannot be made.

use fastphong::compare::metrics::SizeMismatch;
use fastphong::frame::FrameError;
use fastphong::mesh::MeshError;
use fastphong::mesh::builtin::BuiltinError;
use fastphong::number::NameError;
use fastphong::raster::DrawError;
use fastphong::scene::file::SceneError;

/// The result of a part of a figure.
pub(super) type Result<T = (), E = FigureError> = core::result::Result<T, E>;

/// The reason why a figure could not be made.
#[derive(Clone, Debug, thiserror::Error)]
#[error(transparent)]
#[non_exhaustive]
pub enum FigureError {
    /// No built-in mesh has this name, or it has no such parameter.
    Builtin(#[from] BuiltinError),
    /// A mesh is not valid.
    Mesh(#[from] MeshError),
    /// A shipped scene cannot be read.
    Scene(#[from] SceneError),
    /// A frame is not valid.
    Frame(#[from] FrameError),
    /// No method has this name, or it has no such parameter.
    Method(#[from] NameError),
    /// A method cannot draw a frame.
    Draw(#[from] DrawError),
    /// Pictures to be compared have different sizes.
    Size(#[from] SizeMismatch),
}
