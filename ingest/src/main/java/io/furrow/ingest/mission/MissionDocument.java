package io.furrow.ingest.mission;

import io.furrow.mission.bulk.EventDocument;

/**
 * A document for a collection of MongoDB.
 *
 * @param id its {@code _id}, the event id
 * @param bson all of it, {@code _id} included
 * @param event what it was made of, for the dead letter if the server refuses it
 */
public record MissionDocument(String collection, String id, byte[] bson, MissionEvent event) implements EventDocument {}
