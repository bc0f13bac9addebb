//! The error of a figure that cannot be made.

use crate::compare::metrics::SizeMismatch;
use crate::frame::FrameError;
use crate::mesh::MeshError;
use crate::mesh::builtin::BuiltinError;
use crate::number::NameError;
use crate::raster::DrawError;
use crate::scene::file::diagnostics::SceneError;

/// The result of a part of a figure.
pub(super) type Result<T = (), E = FigureError> = core::result::Result<T, E>;

/// An error of the room that a figure draws with.
#[derive(Clone, Debug, thiserror::Error)]
#[error(transparent)]
pub enum FigureError {
    /// A shape has no such name or parameter.
    Builtin(#[from] BuiltinError),
    /// A mesh is not one.
    Mesh(#[from] MeshError),
    /// A shipped scene is not one.
    Scene(#[from] SceneError),
    /// A frame is not one.
    Frame(#[from] FrameError),
    /// A method has no such name or parameter.
    Method(#[from] NameError),
    /// A method is not for a frame.
    Draw(#[from] DrawError),
    /// Pictures that are compared have different sizes.
    Size(#[from] SizeMismatch),
}
