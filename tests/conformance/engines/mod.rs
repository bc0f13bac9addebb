//! Every engine on every instruction set that this machine has, against the lecture's own form, on any number of threads.

mod agreement;
mod coverage;
mod frames;
mod streamed;
mod threads;
