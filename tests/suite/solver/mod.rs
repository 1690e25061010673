mod chapter;
mod dantzig;
mod every;
mod pgs;
mod theory;
