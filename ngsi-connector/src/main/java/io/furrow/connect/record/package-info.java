/** Entities as Connect structs, shared by the source and the sink, and the records that the source writes. */
package io.furrow.connect.record;
