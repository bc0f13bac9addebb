//! fastphong for Python: what `fastphong/__init__.py` asks of the crate.
//!
//! Arrays come as bytes, checked and packed by `fastphong/_meshes.py`; pictures are drawn into byte
//! arrays that numpy then looks at, so that no pixel is copied. Keys of a scene come as TOML, as a
//! scene file has them, and are checked by the crate. Whatever takes time runs without Python's
//! lock.
#![forbid(unsafe_code)]
#![warn(missing_docs)]
#![cfg_attr(clippy, deny(warnings))]

mod errors;
mod mesh;
mod method;
mod picture;
mod pool;
mod proxy;
mod scene;
mod settings;

use pyo3::prelude::*;

#[pymodule]
mod _fastphong {
    #[pymodule_export]
    use super::mesh::{Mesh, vertex_normals};
    #[pymodule_export]
    use super::method::methods;
    #[pymodule_export]
    use super::picture::{difference, difference_map, encode_png, read_picture, write_picture};
    #[pymodule_export]
    use super::scene::Scene;
}
