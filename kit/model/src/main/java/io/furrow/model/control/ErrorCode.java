package io.furrow.model.control;

import io.furrow.model.text.Coded;

/** Why a request was refused: the member {@code error} of the answer. Codes are never renamed, clients branch on them. */
public enum ErrorCode implements Coded {
    /** Not one well-formed JSON document in UTF-8. */
    NOT_JSON,
    /** JSON, but no object with {@code type} {@code request} or {@code response}. */
    NOT_A_REQUEST,
    /** The manager of this topic knows no such {@code command}. */
    UNKNOWN_COMMAND,
    /** The command needs a member that is not there. */
    MISSING_MEMBER,
    /** A member is of another form, or out of its range. */
    WRONG_MEMBER,
    /** A name is not 1 to 64 of {@code A-Z a-z 0-9 _ -}. */
    ILLEGAL_NAME,
    DOMAIN_EXISTS,
    UNKNOWN_DOMAIN,
    /** The domain cannot be deleted while missions run in it. */
    MISSIONS_RUNNING,
    MISSION_EXISTS,
    UNKNOWN_MISSION,
    /** The mission would have to be stopped first. */
    MISSION_RUNNING,
    /** There is nothing to stop. */
    MISSION_NOT_RUNNING,
    /** A mission of this name belongs to another domain. */
    NAME_TAKEN,
    UNKNOWN_TEMPLATE,
    /** Another mission that runs has the device. */
    DEVICE_TAKEN,
    UNKNOWN_DEVICE,
    /** Several tenants or service paths have a device of this id, and the request names none of them. */
    AMBIGUOUS_DEVICE,
    /** The device is not provisioned: it reports by itself. */
    NO_CREDENTIALS,
    UNKNOWN_FIELD,
    UNKNOWN_REPLAY,
    /** Another replay has the name or the topic. */
    REPLAY_EXISTS,
    UNKNOWN_ALARM,
    /** The replay, alarm or field is not in the state that the command needs. */
    WRONG_STATE,
    /** More bytes than {@link Limits} allow, in the request or in what would come of it. */
    TOO_LARGE,
    /** All definitions together would have more bytes than {@link Limits#DEFINITIONS_BYTES}, or more replays would play than may at one time. */
    QUOTA_EXCEEDED,
    /** The id was given before, to a request that asked for something else or came from somebody else. */
    REQUEST_ID_REUSED,
    /** The manager takes no further request at the moment; ask again later. */
    OVERLOADED,
    /** The manager failed at the request and changed nothing; the request is a dead letter. */
    INTERNAL_ERROR;
}
