/** Positions in entities, and the reader that finds them without a tree. */
package io.furrow.model.position;
