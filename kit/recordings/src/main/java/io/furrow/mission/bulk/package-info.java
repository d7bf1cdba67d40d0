/** Writes documents to MongoDB in bulks, and retries or rejects them. */
package io.furrow.mission.bulk;
