//! `Variant::auto` draws naive Phong's picture on every scene and engine.

use crate::support::cases::cases;
use crate::support::differences::levels_apart;
use crate::support::renderers::{name, renderers};
use fastphong::frame::triangulate::triangulated;
use fastphong::picture::Picture8;
use fastphong::raster::{Edges, Renderer};
use fastphong::shading::Variant;

/// On every shipped scene, by every engine and instruction set, every channel is within one level
/// of naive Phong's.
#[test]
fn auto_draws_naive_phongs_picture_to_a_level() {
    let naive = Variant::parse("naive-phong").expect("a method");
    let mut failures = Vec::new();
    for case in cases(Some((213, 160))) {
        let mut check = |by: String, method: &Variant, [expected, actual]: [Picture8; 2]| {
            let (levels, uncovered) = levels_apart(&expected, &actual, |_, _| true);
            if levels > 1 || uncovered > 0 {
                let who = format!("{}, {method} by {by}", case.name);
                failures.push(format!(
                    "{who}: {levels} levels, {uncovered} pixels uncovered"
                ));
            }
        };
        for renderer in renderers() {
            let (method, _) = Variant::auto(&case.frame, renderer);
            let pictures = [&naive, &method].map(|variant| {
                variant
                    .render_with(&case.frame, renderer)
                    .expect("a method for the frame")
            });
            check(name(renderer), &method, pictures);
        }
        let (method, _) = Variant::auto(&case.frame, Renderer::LECTURE);
        let triangles = triangulated(&case.frame).frame;
        let pictures = [&naive, &method].map(|variant| {
            let picture = variant.render_barycentric(&triangles, Edges::TopLeft);
            picture.expect("a method of the barycentric renderer")
        });
        check("triangles".to_owned(), &method, pictures);
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}
