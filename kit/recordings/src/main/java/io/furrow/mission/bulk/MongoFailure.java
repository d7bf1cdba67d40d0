package io.furrow.mission.bulk;

import java.util.Set;
import java.util.regex.Pattern;

import com.mongodb.MongoConfigurationException;
import com.mongodb.MongoException;
import com.mongodb.MongoIncompatibleDriverException;
import com.mongodb.MongoNodeIsRecoveringException;
import com.mongodb.MongoNotPrimaryException;
import com.mongodb.MongoSecurityException;
import com.mongodb.MongoServerException;
import com.mongodb.MongoSocketException;
import com.mongodb.MongoTimeoutException;
import com.mongodb.MongoWriteConcernException;

/** Classifies failures of writes to MongoDB. */
enum MongoFailure {
    /** The server is unavailable or overloaded: retry. */
    UNAVAILABLE,
    /** Nothing can be written until a setting is changed. */
    SETTING,
    /** The server will never accept this document. */
    REJECTED,
    /** The cause may be the document or the server. */
    UNKNOWN;

    private static final int DUPLICATE_KEY = 11000;
    /** The index of {@code _id}, but not others such as {@code device_id_1}. */
    private static final Pattern OF_ID = Pattern.compile("(?<!\\w)_id_(?!\\w)");

    /** Error labels for transient failures; servers under load send the last two. */
    private static final Set<String> TRANSIENT_LABELS =
            Set.of("RetryableWriteError", "TransientTransactionError", "RetryableError", "SystemOverloadedError");

    static MongoFailure of(MongoException failure) {
        boolean unavailable = failure instanceof MongoSocketException
                || failure instanceof MongoTimeoutException
                || failure instanceof MongoNotPrimaryException
                || failure instanceof MongoNodeIsRecoveringException
                || failure instanceof MongoWriteConcernException
                || TRANSIENT_LABELS.stream().anyMatch(failure::hasErrorLabel);
        if (unavailable || failure.getCause() instanceof MongoSocketException) {
            return UNAVAILABLE;
        }
        if (failure instanceof MongoServerException) {
            return of(failure.getCode(), failure.getMessage());
        }
        // The driver's own failure, not caused by a document.
        boolean permanent = failure instanceof MongoSecurityException
                || failure instanceof MongoIncompatibleDriverException
                || failure instanceof MongoConfigurationException;
        return permanent ? SETTING : UNAVAILABLE;
    }

    static MongoFailure of(int code, String message) {
        if (code == DUPLICATE_KEY && OF_ID.matcher(message).find()) {
            return UNAVAILABLE; // two concurrent upserts of a new id: the retry replaces the document
        }
        if (MongoCodes.TRANSIENT.contains(code)) {
            return UNAVAILABLE;
        }
        if (MongoCodes.OF_SETTING.contains(code)) {
            return SETTING;
        }
        return MongoCodes.OF_DOCUMENT.contains(code) ? REJECTED : UNKNOWN;
    }
}
