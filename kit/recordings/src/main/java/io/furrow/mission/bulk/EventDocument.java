package io.furrow.mission.bulk;

/** A document of an event for a collection of MongoDB. */
public interface EventDocument {
    /** Returns the name of the collection. */
    String collection();

    /** Returns its {@code _id}, the event id. */
    String id();

    /** Returns the whole document, including {@code _id}. */
    byte[] bson();
}
