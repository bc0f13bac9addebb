//! The choice of a method that draws naive Phong's picture in the least time.

use super::engine::Renderer;
use crate::frame::Frame;
use crate::shading::Variant;

impl Variant {
    /// Chooses the fastest method that draws naive Phong's picture of `frame` with `renderer`, and
    /// returns it with the reason.
    ///
    /// The rule measures nothing. It picks the method that was fastest in the report of every
    /// shipped scene (`report/README.md`). It considers only methods that interpolate normals and
    /// light each pixel from them, as naive Phong does, so no picture is more than one grey level
    /// of 255 away from naive Phong's. It leaves out methods that step cosines or `N·N` along a
    /// span: Duff's is up to 1.5 times as fast in spans of many pixels, but [`Variant::bound`]
    /// cannot promise one grey level for it.
    ///
    /// ```
    /// use fastphong::mesh::builtin::builtin;
    /// use fastphong::raster::Renderer;
    /// use fastphong::scene::Scene;
    /// use fastphong::shading::Variant;
    ///
    /// let frame = Scene::of_mesh(builtin("sphere")?).frame()?;
    /// let (method, why) = Variant::auto(&frame, Renderer::fastest());
    /// println!("{method}: {why}");
    /// let picture = method.render(&frame)?;
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn auto(frame: &Frame, renderer: Renderer) -> (Variant, &'static str) {
        let named = |name| Variant::parse(name).expect("a method of the table");
        let rsqrt = named("phong-rsqrt");
        let local =
            "under lights or an eye at positions nothing as exact is faster one pixel at a time";
        let span = "naive Phong's picture in less time, one pixel at a time";
        let row = "naive Phong's picture in the least time of the row engine";
        match rsqrt.plan(frame, renderer).renderer() {
            Some(Renderer::Row(_)) => (rsqrt, row),
            _ if frame.is_local() => (named("naive-phong"), local),
            _ => (rsqrt, span),
        }
    }
}
