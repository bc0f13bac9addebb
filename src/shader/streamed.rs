//! Pictures that are given away while they are drawn.

use super::Variant;
use crate::frame::Frame;
use crate::picture::Picture8;
use crate::raster::{Renderer, StreamedBands};
use crate::scene::Encoding;

impl Variant {
    /// Draws `frame` as [`Variant::render_with`] does, and gives its texels to `take` from the top, row by row, some rows at a
    /// time and each soon after it was drawn. The picture is in memory as a whole only where nothing draws it in bands: in the
    /// lecture's own form, and for sRGB. When `take` fails no more is drawn.
    ///
    /// # Errors
    /// Those of `take`.
    ///
    /// ```
    /// use core::convert::Infallible;
    /// use fastphong::mesh::builtin::builtin;
    /// use fastphong::raster::Renderer;
    /// use fastphong::scene::Scene;
    /// use fastphong::shader::Variant;
    ///
    /// let frame = Scene::of_mesh(builtin("sphere")?).frame()?;
    /// let mut texels = 0;
    /// Variant::parse("phong-rsqrt")?.render_rows(&frame, Renderer::fastest(), |rows| {
    ///     texels += rows.len();
    ///     Ok::<(), Infallible>(())
    /// })?;
    /// assert_eq!(texels, frame.picture_width() * frame.picture_height());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn render_rows<E>(
        &self,
        frame: &Frame,
        renderer: Renderer,
        mut take: impl FnMut(&[[u8; 4]]) -> Result<(), E>,
    ) -> Result<(), E> {
        let drawn_by = self.plan(frame, renderer).renderer;
        if let (Encoding::Linear, Renderer::Row(level)) = (frame.encoding(), drawn_by) {
            let mut taken = Ok(());
            let mut take = |texels: &[[u8; 4]]| {
                taken = take(texels);
                taken.is_ok()
            };
            let mut bands = StreamedBands {
                frame,
                take: &mut take,
            };
            if (self.entry().draw_bands)(frame, self.parameters(), level, &mut bands) {
                return taken;
            }
        }
        let mut picture = Picture8::new(0, 0, [0; 4]);
        self.render_with(frame, renderer, &mut picture);
        take(picture.texels())
    }
}
