package io.furrow.model.ngsi;

import io.furrow.model.text.Coded;

/** Why input was set aside; the code stands in the header {@code dead-reason} of the dead letter. */
public enum Reason implements Coded {
    /** Not one well-formed JSON document in UTF-8. */
    NOT_JSON,
    /** Nested deeper, or a string or number longer, than {@link NgsiJson} takes. */
    TOO_DEEP,
    /** More bytes than the receiver takes. */
    TOO_LARGE,
    /** JSON, but no NGSI entity: no object, no id, or attributes of a shape no form has. */
    NOT_AN_ENTITY,
    /** A notification form that does not name its attributes, so that nothing can be made of it, or that of NGSIv1. */
    UNSUPPORTED_FORM,
    /** A record on a topic that lacks what the reader needs, for instance a value where none may be missing. */
    NOT_AN_EVENT,
    /** An image attribute that holds no base64, or neither PNG nor JPEG, or only a part of one. */
    NOT_AN_IMAGE,
    /** Of a time so long after it was received that a clock must be wrong. */
    FROM_THE_FUTURE,
    /** Of a mission or domain that nobody knows, beyond what is taken of such, or of a mission of another domain. */
    UNKNOWN_MISSION,
    /** Written, but refused by the server it was written to. */
    REFUSED,
    /** The reader failed at it: a fault of the program, which the log describes. */
    FAILED;

    /** @param message why it cannot be read, a sentence */
    public void refuseIf(boolean isWrong, String message) throws UnreadableException {
        if (isWrong) {
            throw new UnreadableException(this, message);
        }
    }
}
