/** Entities as Connect structs, shared by the source and the sink. */
package io.furrow.connect.record;
