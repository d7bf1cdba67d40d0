package io.furrow.model.control;

import io.furrow.model.text.Coded;

/** Why a request was rejected: the member {@code error} of the answer. Never renamed: clients depend on it. */
public enum ErrorCode implements Coded {
    /** The value is not a well-formed JSON document in UTF-8. */
    NOT_JSON,
    /** The value is JSON, but not an object with {@code type} {@code request} or {@code response}. */
    NOT_A_REQUEST,
    /** The manager of this topic has no such {@code command}. */
    UNKNOWN_COMMAND,
    /** A required member is missing. */
    MISSING_MEMBER,
    /** A member has the wrong type or is out of range. */
    WRONG_MEMBER,
    /** A name is not 1 to 64 of {@code A-Z a-z 0-9 _ -}. */
    ILLEGAL_NAME,
    DOMAIN_EXISTS,
    UNKNOWN_DOMAIN,
    /** The domain cannot be deleted while its missions run. */
    MISSIONS_RUNNING,
    MISSION_EXISTS,
    UNKNOWN_MISSION,
    /** The mission must be stopped first. */
    MISSION_RUNNING,
    /** The mission is not running. */
    MISSION_NOT_RUNNING,
    /** A mission of this name belongs to another domain. */
    NAME_TAKEN,
    UNKNOWN_TEMPLATE,
    /** Another running mission has the device. */
    DEVICE_TAKEN,
    UNKNOWN_DEVICE,
    /** Several tenants or service paths have a device of this id, and the request names none of them. */
    AMBIGUOUS_DEVICE,
    /** The device is not provisioned and has credentials of its own. */
    NO_CREDENTIALS,
    UNKNOWN_FIELD,
    UNKNOWN_REPLAY,
    /** Another replay has the name or the topic. */
    REPLAY_EXISTS,
    UNKNOWN_ALARM,
    /** The replay, alarm or field is not in the state that the command needs. */
    WRONG_STATE,
    /** What the request changes has another sequence than the request names. */
    OUTDATED,
    /** The request or its result exceeds {@link Limits}. */
    TOO_LARGE,
    /** The definitions would exceed {@link Limits#DEFINITIONS_BYTES}, or too many replays would play at once. */
    QUOTA_EXCEEDED,
    /** The id belongs to an earlier request with another content or from another user. */
    REQUEST_ID_REUSED,
    /** The manager accepts no further requests now; retry later. */
    OVERLOADED,
    /** The manager failed and changed nothing; the request is a dead letter. */
    INTERNAL_ERROR;
}
