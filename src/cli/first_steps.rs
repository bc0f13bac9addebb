//! The text for who starts the program without knowing it.

/// Five commands to try, and where help is: what the program says when it is given nothing to do.
pub const FIRST_STEPS: &str = "\
Eleven ways to shade polygons, from flat to Phong, to draw, time and check. Five things to try:

  fastphong render builtin:teapot -o teapot.png          a picture; your bunny.obj does as well
  fastphong render two-lights -m fast-phong -o fast.png  where the lecture's method shows its facets
  fastphong compare teapot                               a row a method: its error, its time
  fastphong explain fast-phong                           formula, cost, where it fails
  fastphong report                                       all of it on one page, in about a minute

fastphong --help has all commands, fastphong list scenes what to draw.
";
