//! The paper's own recursion: division of the pocket by random maximal disks.
//!
//! A second builder behind the same [`Mat`](super::Mat), slow and for judging the first: it shares
//! with it sites, the touch formula and the types of the graph, and none of the steps that decide
//! what is connected with what.
//!
//! **Needs** a pocket whose boundary hangs together: without islands, or with islands that touch it.
//! **Guarantees** what `mat` does; what is random comes from a fixed seed.
//! **Does not** scale: every disk costs time linear in the size of its subdomain.
//!
//! **Method** (the names are the paper's). A *subdomain* is a closed row of pieces of the boundary,
//! joined by corners of the drawing or by *artificial arcs* of earlier disks (`subdomain`). Until it is
//! a *base case* of Fig. 5 or 6 (`base_case`), the *maximal disk* at a place of a random arc (`disk`)
//! divides it into as many subdomains as the disk has tangent points. A disk that cuts off nothing but
//! parts of two neighbors is *non-reducing*; then `maximaldisk*` finds the *branching disk* where the
//! edge between these two ends (`star`, `apollonius`), and each part lacks a piece. To *conquer* is to
//! leave the parts as they are: they meet in the centers of the dividing disks (`conquer`).
//!
//! Source: Aichholzer, Aigner, Aurenhammer, Hackl, Juettler, Rabl: *Medial axis computation for planar
//! free-form shapes*, Computer-Aided Design 41 (2009), section 3, Algorithms 3 and 4.

mod apollonius;
mod base_case;
mod conquer;
mod disk;
mod medialaxis;
mod star;
mod subdomain;
