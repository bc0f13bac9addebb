//! Why a figure could not be made.

use crate::compare::metrics::SizeMismatch;
use crate::frame::FrameError;
use crate::mesh::MeshError;
use crate::mesh::builtin::BuiltinError;
use crate::scene::file::diagnostics::SceneError;
use crate::shading::MethodError;

/// Why a figure could not be made: the room it is drawn from refused.
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
    Method(#[from] MethodError),
    /// Pictures that are compared have different sizes.
    Size(#[from] SizeMismatch),
}
