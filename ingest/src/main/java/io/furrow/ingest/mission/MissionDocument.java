package io.furrow.ingest.mission;

import io.furrow.mission.bulk.EventDocument;

/**
 * A document for a collection of MongoDB.
 *
 * @param id its {@code _id}, the event id
 * @param bson the document, including {@code _id}
 * @param event its source, for the dead letter if the server refuses it
 */
public record MissionDocument(String collection, String id, byte[] bson, MissionEvent event) implements EventDocument {}
