/** Missions in MongoDB: documents, queries and collections. */
package io.furrow.mission.mongo;
