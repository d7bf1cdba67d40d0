/** Stores every event of a mission as a document in MongoDB. */
package io.furrow.ingest.mission;
