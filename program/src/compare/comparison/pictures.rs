//! Draws the pictures of a comparison and measures them against the references.

use super::{DrawnBy, MethodRow, Triangulation};
use alloc::borrow::Cow;
use core::cell::OnceCell;
use fastphong::compare::metrics::{Difference, compare_where, ssim_where};
use fastphong::frame::Frame;
use fastphong::frame::triangulate::Triangulated;
use fastphong::picture::encoding::store;
use fastphong::picture::{Encoding, LevelRows, Levels, LinearPicture, Picture, Picture8};
use fastphong::raster::{Edges, Renderer, barycentric_polygon_indices, polygon_indices};
use fastphong::reference::{self, Clamping, ClosedForm, Model, Visibility};
use fastphong::scene::Power;
use fastphong::shading::Variant;

/// The references of one frame, and the polygons that renderers show.
pub(super) struct References<'a> {
    cut: &'a Triangulated,
    closed_forms: ClosedForms<'a>,
    /// The closed forms on triangles; `None` if the polygons are triangles.
    on_triangles: Option<ClosedForms<'a>>,
    /// The indices of the polygons that the span engine shows, which are equal for all methods;
    /// made on first use.
    span: OnceCell<Picture<u32>>,
    /// The indices of the triangles that the barycentric renderer shows.
    barycentric: Picture<u32>,
}

/// The reference pictures of one frame. Each is made on first use.
struct ClosedForms<'a> {
    frame: &'a Frame,
    visibility: Visibility,
    pictures: [OnceCell<LinearPicture>; Model::ALL.len()],
    /// The clamped samples of the Phong reference, counted when it is drawn.
    clamping: OnceCell<Clamping>,
}

impl<'a> ClosedForms<'a> {
    fn new(frame: &'a Frame) -> Self {
        ClosedForms {
            frame,
            visibility: reference::visibility(frame),
            pictures: Default::default(),
            clamping: OnceCell::new(),
        }
    }

    fn picture(&self, model: Model) -> &LinearPicture {
        self.pictures[model as usize].get_or_init(|| self.shaded(model.into()))
    }

    fn shaded(&self, form: ClosedForm) -> LinearPicture {
        let (shaded, clamping) = reference::shade_and_count(self.frame, &self.visibility, form);
        if form == Model::Phong.into() {
            self.clamping.get_or_init(|| clamping);
        }
        shaded.to_linear()
    }
}

/// A variant's drawing, compared with its closed form but not yet with the Phong reference.
struct ComparedDrawing {
    picture: Picture8,
    linear: LinearPicture,
    /// The difference from the variant's closed form, or `None` if that is the Phong reference.
    own: Option<Difference>,
    bound: f64,
}

impl<'a> References<'a> {
    /// Prepares the references of `frame`. `cut` is the frame cut into triangles.
    pub fn new(frame: &'a Frame, cut: &'a Triangulated) -> Self {
        let is_cut = frame.polygons().iter().any(|polygon| polygon.count > 3);
        References {
            cut,
            closed_forms: ClosedForms::new(frame),
            on_triangles: is_cut.then(|| ClosedForms::new(&cut.frame)),
            span: OnceCell::new(),
            barycentric: barycentric_polygon_indices(&cut.frame, Edges::TopLeft),
        }
    }

    /// Returns the Phong reference.
    pub fn phong(&self) -> &LinearPicture {
        self.closed_forms.picture(Model::Phong)
    }

    /// Returns the clamped samples of the Phong reference.
    pub fn clamping(&self) -> Clamping {
        self.phong();
        self.closed_forms
            .clamping
            .get()
            .cloned()
            .unwrap_or_default()
    }

    /// Draws a variant by `renderer` and compares it. The variant must not refuse the frame.
    pub fn scanline_row(&self, variant: &Variant, renderer: Renderer) -> MethodRow {
        const IS_FOR: &str = "others are left out";
        let forms = &self.closed_forms;
        let planned = variant
            .plan(forms.frame, renderer)
            .renderer()
            .unwrap_or(renderer);
        let by = DrawnBy::new(planned);
        let shown = &*self.shown(variant, planned);
        let linear = variant
            .render_linear_with(forms.frame, renderer)
            .expect(IS_FOR);
        let picture = variant.render_with(forms.frame, renderer).expect(IS_FOR);
        let own = match variant.closed_form() {
            form if form == Model::Phong.into() => None,
            form => Some(forms.difference(form, &linear, shown)),
        };
        let bound = variant.bound(forms.frame);
        let drawing = ComparedDrawing {
            picture,
            linear,
            own,
            bound,
        };
        self.row(variant, by, drawing, shown)
    }

    /// Returns the indices of the polygons that a variant shows, drawn by `renderer`.
    fn shown(&self, variant: &Variant, renderer: Renderer) -> Cow<'_, Picture<u32>> {
        let frame = self.closed_forms.frame;
        match renderer {
            Renderer::Span => Cow::Borrowed(self.span.get_or_init(|| polygon_indices(frame))),
            Renderer::Row(_) => Cow::Owned(variant.polygon_indices(frame, renderer)),
        }
    }

    /// Draws a variant by the barycentric renderer and compares it. Returns `None` if the renderer
    /// does not have the method.
    pub fn barycentric_row(&self, variant: &Variant) -> Option<MethodRow> {
        let linear = variant.render_barycentric_linear(&self.cut.frame, Edges::TopLeft)?;
        let picture = variant.render_barycentric(&self.cut.frame, Edges::TopLeft)?;
        let forms = self.on_triangles.as_ref().unwrap_or(&self.closed_forms);
        let own = forms.difference(variant.closed_form(), &linear, &self.barycentric);
        let (by, shown) = (DrawnBy::BARYCENTRIC, self.origins(&self.barycentric));
        let drawing = ComparedDrawing {
            picture,
            linear,
            own: Some(own),
            bound: variant.bound(&self.cut.frame),
        };
        Some(self.row(variant, by, drawing, &shown))
    }

    /// Compares the Phong reference on triangles with the one on polygons. Returns `None` if the
    /// polygons are triangles.
    pub fn triangulation(&self) -> Option<Triangulation> {
        let triangles = self.on_triangles.as_ref()?;
        let shown = self.origins(&triangles.visibility.polygons);
        let picture = triangles.picture(Model::Phong);
        Some(Triangulation {
            triangles: self.cut.frame.polygons().len(),
            not_simple: self.cut.not_simple,
            difference: self.closed_forms.difference(Model::Phong, picture, &shown),
        })
    }

    /// Replaces the indices of triangles by those of the polygons that they were cut from.
    fn origins(&self, triangles: &Picture<u32>) -> Picture<u32> {
        let origin = |triangle| self.cut.origins.get(triangle as usize);
        triangles.map(|triangle| origin(triangle).copied().unwrap_or(Visibility::NONE))
    }

    /// Makes the row for a drawing. `shown` holds the polygons that its pictures show.
    fn row(
        &self,
        variant: &Variant,
        drawn_by: DrawnBy,
        drawing: ComparedDrawing,
        shown: &Picture<u32>,
    ) -> MethodRow {
        let ComparedDrawing {
            picture,
            linear,
            own,
            bound,
        } = drawing;
        let error = self.closed_forms.difference(Model::Phong, &linear, shown);
        let own = own.unwrap_or(error);
        let is_clamped = |pixel: &&[f32; 4]| pixel[3] > 0.0 && pixel[..3].contains(&1.0);
        MethodRow {
            variant: variant.clone(),
            drawn_by,
            error,
            own,
            bound,
            approximation: variant.approximation(self.closed_forms.frame),
            within_bound: own.max <= bound,
            other_polygon: error.excluded,
            clamped: linear.pixels().iter().filter(is_clamped).count(),
            kinds: variant.polygon_kinds(self.closed_forms.frame),
            speed: None,
            picture,
        }
    }
}

impl ClosedForms<'_> {
    /// Compares `actual` with a closed form at the pixels where both show the same polygon.
    fn difference(
        &self,
        form: impl Into<ClosedForm>,
        actual: &LinearPicture,
        shown: &Picture<u32>,
    ) -> Difference {
        let (form, seen) = (form.into(), &self.visibility.polygons);
        // Forms with other powers are needed only once or twice, so they are not kept.
        let reference = match form.power {
            Power::Squaring => Cow::Borrowed(self.picture(form.model)),
            _ => Cow::Owned(self.shaded(form)),
        };
        difference(&reference, actual, [seen, shown], self.frame.encoding())
    }
}

/// True if both show the same polygon at each of the `side` × `side` samples of pixel (`x`, `y`).
fn same_polygons([seen, shown]: [&Picture<u32>; 2], side: usize, x: usize, y: usize) -> bool {
    let columns = x * side..(x + 1) * side;
    (y * side..(y + 1) * side)
        .all(|row| seen.row(row)[columns.clone()] == shown.row(row)[columns.clone()])
}

/// Compares two pictures at the pixels where they show the same polygon. SSIM compares the stored
/// pictures as a screen shows them.
fn difference(
    reference: &LinearPicture,
    actual: &LinearPicture,
    polygons: [&Picture<u32>; 2],
    encoding: Encoding,
) -> Difference {
    const ONE_SIZE: &str = "pictures of one frame have one size";
    let side = polygons[0].width() / reference.width();
    let mut same = Picture::new(reference.width(), reference.height(), false);
    for y in 0..same.height() {
        for (x, same) in same.row_mut(y).iter_mut().enumerate() {
            *same = same_polygons(polygons, side, x, y);
        }
    }
    // It is asked three times for each pixel.
    let is_same = |x, y| same.get(x, y);
    let stored = [reference, actual].map(|picture| store(picture, encoding));
    let [r, a] = stored
        .each_ref()
        .map(|picture| Displayed { picture, encoding });
    let mut difference = compare_where(reference, actual, is_same).expect(ONE_SIZE);
    difference.ssim = ssim_where(&r, &a, is_same).expect(ONE_SIZE);
    difference
}

/// A stored picture as a screen shows it: in sRGB levels, without rounding again. Alpha is ignored.
#[derive(Clone, Copy, Debug)]
pub(super) struct Displayed<'a> {
    /// The picture.
    pub picture: &'a Picture8,
    /// Its encoding.
    pub encoding: Encoding,
}

impl LevelRows for Displayed<'_> {
    fn size(&self) -> [usize; 2] {
        [self.picture.width(), self.picture.height()]
    }

    fn level_row(&self, y: usize, levels: &mut [Levels]) {
        let shown: [f64; 256] = core::array::from_fn(|level| match self.encoding {
            Encoding::Srgb => level as f64,
            Encoding::Linear => 255.0 * Encoding::Srgb.encode(level as f64 / 255.0),
        });
        for (levels, [r, g, b, _]) in levels.iter_mut().zip(self.picture.row(y)) {
            let [r, g, b] = [r, g, b].map(|level| shown[usize::from(*level)]);
            *levels = Levels([r, g, b, 255.0]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_model_has_its_own_index() {
        for (index, model) in Model::ALL.into_iter().enumerate() {
            assert_eq!(model as usize, index);
        }
    }

    #[test]
    fn a_pixel_is_the_same_if_all_its_samples_are() {
        let samples = Picture::from_pixels(4, 2, [1, 1, 2, 2, 1, 1, 2, 3].into()).unwrap();
        for changed in 0..8 {
            let mut other = samples.clone();
            other.pixels_mut()[changed] = 9;
            let same = [0, 1].map(|x| same_polygons([&samples, &other], 2, x, 0));
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
        let seen = Picture::from_pixels(2, 1, [3, 4].into()).unwrap();
        let shown = Picture::from_pixels(2, 1, [3, 5].into()).unwrap();
        let same = difference(&reference, &actual, [&seen, &seen], Encoding::Linear);
        assert!(same.max > 0.39 && same.excluded == 0);
        let masked = difference(&reference, &actual, [&seen, &shown], Encoding::Linear);
        assert!(masked.equal && masked.compared == 1 && masked.excluded == 1);
    }
}
