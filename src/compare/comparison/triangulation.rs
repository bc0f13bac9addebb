//! How far a frame of polygons lies from the same frame cut into triangles.
//!
//! Values interpolated along scanlines depend on the orientation of a polygon of four corners or more; on triangles they
//! do not (L21 3, Figure 5). Cutting polygons into triangles therefore makes another picture, and this tells how other.

use super::pictures::same_polygons;
use crate::compare::metrics::{Difference, compare_where};
use crate::frame::Frame;
use crate::frame::triangulate::triangulated;
use crate::picture::LinearPicture;
use crate::reference::{self, Model, Visibility};

/// The Phong reference of a frame cut into triangles, against that of its polygons.
#[derive(Clone, Debug)]
pub struct Triangulation {
    /// Triangles that the frame was cut into.
    pub triangles: usize,
    /// Polygons left out because they cross themselves on the picture.
    pub not_simple: usize,
    /// The difference, where both show the same polygon.
    pub difference: Difference,
    /// The reference of the triangles.
    pub picture: LinearPicture,
}

/// What cutting the polygons of `frame` by [`triangulated`] does to its Phong reference, which is `reference`; `None` if
/// they are triangles already.
pub fn triangulation(frame: &Frame, reference: &LinearPicture) -> Option<Triangulation> {
    if frame.polygons().iter().all(|polygon| polygon.count == 3) {
        return None;
    }
    let cut = triangulated(frame);
    let visible = reference::visibility(&cut.frame);
    let picture = reference::shade(&cut.frame, &visible, Model::Phong).to_linear();
    let origin = |triangle| {
        cut.origins
            .get(triangle as usize)
            .copied()
            .unwrap_or(Visibility::NONE)
    };
    let (seen, shown) = (
        reference::visibility(frame).polygons,
        visible.polygons.map(origin),
    );
    let difference = compare_where(reference, &picture, |x, y| {
        same_polygons(&seen, &shown, reference, x, y)
    });
    let difference = difference.expect("pictures of one frame have one size");
    Some(Triangulation {
        triangles: cut.frame.polygons().len(),
        not_simple: cut.not_simple,
        difference,
        picture,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::builtin::builtin;
    use crate::scene::Scene;

    fn of(mesh: &str) -> Option<Triangulation> {
        let mut scene = Scene::of_mesh(builtin(mesh).unwrap());
        (scene.width, scene.height) = (64, 48);
        let frame = scene.frame().unwrap();
        let reference = reference::render(&frame, Model::Phong).to_linear();
        triangulation(&frame, &reference)
    }

    #[test]
    fn triangles_are_not_cut_and_quadrangles_change() {
        assert!(of("triangle").is_none());
        let quadrangles = of("sphere?rings=4&segments=8").unwrap();
        assert!(quadrangles.triangles > 0 && quadrangles.not_simple == 0);
        assert!(
            quadrangles.difference.max > 1.0 / 255.0,
            "{:?}",
            quadrangles.difference
        );
        assert!(
            quadrangles.difference.coverage_mismatches == 0,
            "the same pixels"
        );
    }

    #[test]
    fn the_picture_is_the_phong_reference_of_the_triangles() {
        let mut scene = Scene::of_mesh(builtin("sphere?rings=4&segments=8").unwrap());
        (scene.width, scene.height) = (64, 48);
        let frame = scene.frame().unwrap();
        let cut =
            triangulation(&frame, &reference::render(&frame, Model::Phong).to_linear()).unwrap();
        assert_eq!(
            cut.picture,
            reference::render(&triangulated(&frame).frame, Model::Phong).to_linear()
        );
    }

    #[test]
    fn a_flat_face_with_equal_normals_stays_as_it_is() {
        let mut scene = Scene::of_mesh(builtin("prism").unwrap());
        (scene.width, scene.height) = (64, 48);
        for object in &mut scene.objects {
            object.normals = crate::mesh::vertex_normals::NormalSource::Crease(10.0);
        }
        let frame = scene.frame().unwrap();
        let reference = reference::render(&frame, Model::Phong).to_linear();
        let cut = triangulation(&frame, &reference).unwrap();
        // Results of f64 that agree but for its rounding may become neighbours in f32, 2⁻²⁴ apart below 1.
        assert!(
            cut.difference.max <= f64::from(f32::EPSILON) / 2.0,
            "{:?}",
            cut.difference
        );
    }
}
