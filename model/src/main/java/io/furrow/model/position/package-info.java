/** Positions in entities. */
package io.furrow.model.position;
