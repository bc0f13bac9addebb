//! Pictures against references.

use super::{Engine, Row};
use crate::compare::metrics::{Difference, compare_where};
use crate::frame::Frame;
use crate::frame::triangulate::{Triangulated, triangulated};
use crate::number::Level;
use crate::picture::{LinearPicture, Picture};
use crate::raster::{Edges, Renderer, barycentric_polygon_numbers, polygon_numbers};
use crate::reference::{self, Model, Visibility};
use crate::shading::Variant;
use core::cell::OnceCell;

/// What the pictures of one frame are compared with.
pub(super) struct References {
    /// The Phong reference.
    pub phong: LinearPicture,
    /// The frame as the barycentric renderer draws it.
    pub triangulated: Triangulated,
    closed_forms: ClosedForms,
    /// Those on triangles, where they are not the same.
    on_triangles: Option<ClosedForms>,
    /// What the engines show that draw by scanlines.
    scanline: Picture<u32>,
    /// What the barycentric renderer shows, as triangles.
    barycentric: Picture<u32>,
}

/// The reference pictures of one frame; each is made when it is first asked for.
struct ClosedForms {
    visibility: Visibility,
    pictures: [OnceCell<LinearPicture>; Model::ALL.len()],
}

impl ClosedForms {
    fn new(frame: &Frame) -> Self {
        ClosedForms {
            visibility: reference::visibility(frame),
            pictures: Default::default(),
        }
    }

    /// The picture of `frame`, the one that this was made for.
    fn picture(&self, frame: &Frame, model: Model) -> &LinearPicture {
        self.pictures[model as usize]
            .get_or_init(|| reference::shade(frame, &self.visibility, model).to_linear())
    }
}

impl References {
    pub fn new(frame: &Frame) -> Self {
        let closed_forms = ClosedForms::new(frame);
        let triangulated = triangulated(frame);
        let is_cut = frame.polygons().iter().any(|polygon| polygon.count > 3);
        References {
            phong: closed_forms.picture(frame, Model::Phong).clone(),
            on_triangles: is_cut.then(|| ClosedForms::new(&triangulated.frame)),
            scanline: polygon_numbers(frame),
            barycentric: barycentric_polygon_numbers(&triangulated.frame, Edges::TopLeft),
            closed_forms,
            triangulated,
        }
    }

    /// Pixels that any polygon covers, in part at least where a pixel has several samples.
    pub fn covered_pixels(&self) -> usize {
        self.phong
            .texels()
            .iter()
            .filter(|texel| texel[3] > 0.0)
            .count()
    }

    /// The row of a variant as `renderer` draws it, without times.
    pub fn scanline_row(&self, frame: &Frame, variant: &Variant, renderer: Renderer) -> Row {
        let drawn_by = variant.plan(frame, renderer).renderer;
        let linear = variant.render_linear_with(frame, renderer);
        let seen = &self.closed_forms.visibility.polygons;
        let (error, other_polygon) = difference(&self.phong, &linear, seen, &self.scanline);
        let own = match variant.info().model {
            Model::Phong => error,
            model => {
                difference(
                    self.closed_forms.picture(frame, model),
                    &linear,
                    seen,
                    &self.scanline,
                )
                .0
            }
        };
        let mut picture = Picture::new(0, 0, [0; 4]);
        variant.render_with(frame, renderer, &mut picture);
        Row {
            variant: variant.clone(),
            engine: Engine::Scanlines(drawn_by.engine()),
            level: drawn_by.level(),
            threads: drawn_by.threads(),
            error,
            own,
            bound: variant.bound(frame),
            other_polygon,
            speed: None,
            picture,
            linear,
        }
    }

    /// The row of a variant in the barycentric renderer, without times; `None` if it does not have the method.
    pub fn barycentric_row(&self, variant: &Variant) -> Option<Row> {
        let frame = &self.triangulated.frame;
        let linear = variant.render_barycentric_linear(frame, Edges::TopLeft)?;
        let origin = |triangle| {
            self.triangulated
                .origins
                .get(triangle as usize)
                .copied()
                .unwrap_or(Visibility::NONE)
        };
        let shown = self.barycentric.map(origin);
        let seen = &self.closed_forms.visibility.polygons;
        let (error, other_polygon) = difference(&self.phong, &linear, seen, &shown);
        let own_forms = self.on_triangles.as_ref().unwrap_or(&self.closed_forms);
        let closed_form = own_forms.picture(frame, variant.info().model);
        let (own, _) = difference(
            closed_form,
            &linear,
            &own_forms.visibility.polygons,
            &self.barycentric,
        );
        let picture = variant.render_barycentric(frame, Edges::TopLeft)?;
        Some(Row {
            variant: variant.clone(),
            engine: Engine::Barycentric,
            level: Level::Scalar,
            threads: 1,
            error,
            own,
            bound: variant.bound(frame),
            other_polygon,
            speed: None,
            picture,
            linear,
        })
    }
}

/// True if all samples of a pixel of `picture` show the same polygon in both.
pub(super) fn same_polygons(
    seen: &Picture<u32>,
    shown: &Picture<u32>,
    picture: &LinearPicture,
    x: usize,
    y: usize,
) -> bool {
    let side = seen.width() / picture.width();
    let columns = x * side..(x + 1) * side;
    (y * side..(y + 1) * side)
        .all(|row| seen.row(row)[columns.clone()] == shown.row(row)[columns.clone()])
}

/// The difference where both show the same polygon, and the number of pixels where they do not.
fn difference(
    reference: &LinearPicture,
    actual: &LinearPicture,
    seen: &Picture<u32>,
    shown: &Picture<u32>,
) -> (Difference, usize) {
    let difference = compare_where(reference, actual, |x, y| {
        same_polygons(seen, shown, reference, x, y)
    });
    let difference = difference.expect("pictures of one frame have one size");
    (difference, difference.excluded)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_model_has_its_own_place() {
        for (place, model) in Model::ALL.into_iter().enumerate() {
            assert_eq!(model as usize, place);
        }
    }

    #[test]
    fn a_pixel_is_the_same_if_all_its_samples_are() {
        let picture = Picture::new(2, 1, [0.0; 4]);
        let samples = Picture::from_texels(4, 2, [1, 1, 2, 2, 1, 1, 2, 3].into()).unwrap();
        for changed in 0..8 {
            let mut other = samples.clone();
            other.texels_mut()[changed] = 9;
            let same = [0, 1].map(|x| same_polygons(&samples, &other, &picture, x, 0));
            assert_eq!(
                same,
                [changed % 4 >= 2, changed % 4 < 2],
                "sample {changed}"
            );
        }
    }

    #[test]
    fn pixels_of_other_polygons_are_counted_and_not_compared() {
        let reference = Picture::new(2, 1, [0.5, 0.5, 0.5, 1.0]);
        let mut actual = reference.clone();
        actual.row_mut(0)[1] = [0.9, 0.9, 0.9, 1.0];
        let seen = Picture::from_texels(2, 1, [3, 4].into()).unwrap();
        let shown = Picture::from_texels(2, 1, [3, 5].into()).unwrap();
        let (same, none) = difference(&reference, &actual, &seen, &seen);
        assert!(same.max > 0.39 && none == 0);
        let (masked, one) = difference(&reference, &actual, &seen, &shown);
        assert!(masked.equal && masked.compared == 1 && one == 1);
    }
}
