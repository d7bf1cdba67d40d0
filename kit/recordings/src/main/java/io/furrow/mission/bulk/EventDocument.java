package io.furrow.mission.bulk;

/** A document of an event for a collection of MongoDB. */
public interface EventDocument {
    /** The name of the collection. */
    String collection();

    /** Its {@code _id}, the event id. */
    String id();

    /** All of it, {@code _id} included. */
    byte[] bson();
}
