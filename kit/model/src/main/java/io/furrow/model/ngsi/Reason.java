package io.furrow.model.ngsi;

import io.furrow.model.text.Coded;

/** Why input was rejected; the code is the header {@code dead-reason} of the dead letter. */
public enum Reason implements Coded {
    /** The input is not a well-formed JSON document in UTF-8. */
    NOT_JSON,
    /** Nesting, strings or numbers exceed the limits of {@link NgsiJson}. */
    TOO_DEEP,
    /** The input exceeds the receiver's limit. */
    TOO_LARGE,
    /** The input is JSON but not an NGSI entity: not an object, no id, or attributes of an unknown shape. */
    NOT_AN_ENTITY,
    /** A notification without the names of its attributes, or of NGSIv1. */
    UNSUPPORTED_FORM,
    /** A record without a part that the reader needs, for instance a value. */
    NOT_AN_EVENT,
    /** An image attribute that is not base64, neither PNG nor JPEG, or truncated. */
    NOT_AN_IMAGE,
    /** The event time is so long after the receipt that a clock must be wrong. */
    FROM_THE_FUTURE,
    /** The mission or domain is unknown beyond the limit of such, or the mission belongs to another domain. */
    UNKNOWN_MISSION,
    /** The target server rejected it. */
    REFUSED,
    /** The reader failed because of a defect, which the log describes. */
    FAILED;

    /** @param message why it cannot be read, a sentence */
    public void refuseIf(boolean isWrong, String message) throws UnreadableException {
        if (isWrong) {
            throw new UnreadableException(this, message);
        }
    }
}
