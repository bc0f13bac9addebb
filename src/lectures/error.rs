//! Why a figure could not be made.

use crate::compare::metrics::SizeMismatch;
use crate::frame::FrameError;
use crate::mesh::MeshError;
use crate::mesh::builtin::BuiltinError;
use crate::scene::input::InputError;
use crate::shading::MethodError;
use core::fmt;

/// Why a figure could not be made: what it is drawn from refused.
#[derive(Clone, Debug)]
pub enum FigureError {
    /// A shape has no such name or parameter.
    Builtin(BuiltinError),
    /// A mesh is not one.
    Mesh(MeshError),
    /// A shipped scene is not one.
    Scene(InputError),
    /// A frame is not one.
    Frame(FrameError),
    /// A method has no such name or parameter.
    Method(MethodError),
    /// Pictures that are compared have different sizes.
    Size(SizeMismatch),
}

impl fmt::Display for FigureError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            FigureError::Builtin(error) => error.fmt(f),
            FigureError::Mesh(error) => error.fmt(f),
            FigureError::Scene(error) => error.fmt(f),
            FigureError::Frame(error) => error.fmt(f),
            FigureError::Method(error) => error.fmt(f),
            FigureError::Size(error) => error.fmt(f),
        }
    }
}

impl core::error::Error for FigureError {}

impl From<BuiltinError> for FigureError {
    fn from(error: BuiltinError) -> Self {
        FigureError::Builtin(error)
    }
}

impl From<MeshError> for FigureError {
    fn from(error: MeshError) -> Self {
        FigureError::Mesh(error)
    }
}

impl From<InputError> for FigureError {
    fn from(error: InputError) -> Self {
        FigureError::Scene(error)
    }
}

impl From<FrameError> for FigureError {
    fn from(error: FrameError) -> Self {
        FigureError::Frame(error)
    }
}

impl From<MethodError> for FigureError {
    fn from(error: MethodError) -> Self {
        FigureError::Method(error)
    }
}

impl From<SizeMismatch> for FigureError {
    fn from(error: SizeMismatch) -> Self {
        FigureError::Size(error)
    }
}
