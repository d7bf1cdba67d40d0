/** Documents to MongoDB in bulks: what is tried again, what is refused. */
package io.furrow.mission.bulk;
