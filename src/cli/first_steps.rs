//! The text for who starts the program without knowing it.

/// Five commands to try, and where help is: what the program says when it is given nothing to do.
pub const FIRST_STEPS: &str = "\
Draw, time and check eleven ways to shade polygons, from flat to Phong. Five things to try:

  fastphong render builtin:teapot -o teapot.png          a picture; or use your own bunny.obj
  fastphong render two-lights -m fast-phong -o fast.png  lights nearby: fast Phong shows facets
  fastphong compare teapot                               one row per method: error and time
  fastphong explain fast-phong                           formula, cost, where it fails
  fastphong report                                       all of it on one page, in half a minute

fastphong --help lists all commands, fastphong list scenes the scenes.
";
