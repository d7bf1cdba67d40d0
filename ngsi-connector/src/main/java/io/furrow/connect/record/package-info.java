/** Entities as Connect's structs, the same in the source and in the sink. */
package io.furrow.connect.record;
