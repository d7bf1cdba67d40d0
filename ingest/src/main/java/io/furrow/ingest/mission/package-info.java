/** Every event of a mission as a document in MongoDB, and as a line of an archive. */
package io.furrow.ingest.mission;
