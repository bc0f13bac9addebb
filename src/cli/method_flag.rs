//! `--method`: a method by name, or `auto`, which is chosen once the frame is there.

use super::drawing::{self, AUTO, Method};
use super::engines::EngineFlag;
use fastphong::frame::Frame;
use fastphong::raster::Renderer;
use fastphong::shading::Variant;

/// The method that was asked for: `None` is `auto`.
#[derive(Clone, Debug)]
pub struct AskedMethod(Option<Method>);

/// Reads `auto`, or a method as [`drawing::method`] does.
pub fn asked_method(text: &str) -> Result<AskedMethod, String> {
    match text {
        AUTO => Ok(AskedMethod(None)),
        name => drawing::method(name).map(|method| AskedMethod(Some(method))),
    }
}

impl AskedMethod {
    /// Returns the method to draw `frame` with, and why if it was chosen here.
    pub fn choose(
        &self,
        frame: &Frame,
        engine: EngineFlag,
        renderer: Renderer,
    ) -> (Method, Option<&'static str>) {
        if let Some(method) = &self.0 {
            return (method.clone(), None);
        }
        let (variant, why) = match engine {
            EngineFlag::Cs171 { .. } => {
                let variant = Variant::parse("naive-phong").expect("a method of the table");
                (variant, "CS171 has no other that lights each pixel")
            }
            EngineFlag::Scanlines(_) | EngineFlag::Barycentric(_) => Variant::auto(frame, renderer),
        };
        (Method::Variant(variant), Some(why))
    }
}
