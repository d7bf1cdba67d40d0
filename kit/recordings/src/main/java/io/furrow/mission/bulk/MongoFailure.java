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

/** What a failure of MongoDB means for what was to be written. */
enum MongoFailure {
    /** The server is not there, or is busy with itself: try again. */
    UNAVAILABLE,
    /** Nothing can be written until somebody changes a setting. */
    SETTING,
    /** The server will never take this document. */
    REFUSED,
    /** The server did not say whether it is the document's fault. */
    UNKNOWN;

    private static final int DUPLICATE_KEY = 11000;
    /** The index of {@code _id}, and no other whose name has this in it, such as {@code device_id_1}. */
    private static final Pattern OF_ID = Pattern.compile("(?<!\\w)_id_(?!\\w)");

    /** By which a server says that the same may pass later; the last two of servers under load. */
    private static final Set<String> PASSING =
            Set.of("RetryableWriteError", "TransientTransactionError", "RetryableError", "SystemOverloadedError");

    static MongoFailure of(MongoException failure) {
        boolean away = failure instanceof MongoSocketException
                || failure instanceof MongoTimeoutException
                || failure instanceof MongoNotPrimaryException
                || failure instanceof MongoNodeIsRecoveringException
                || failure instanceof MongoWriteConcernException
                || PASSING.stream().anyMatch(failure::hasErrorLabel);
        if (away || failure.getCause() instanceof MongoSocketException) {
            return UNAVAILABLE;
        }
        if (failure instanceof MongoServerException) {
            return of(failure.getCode(), failure.getMessage());
        }
        // The driver's own: it says nothing of any document.
        boolean hopeless = failure instanceof MongoSecurityException
                || failure instanceof MongoIncompatibleDriverException
                || failure instanceof MongoConfigurationException;
        return hopeless ? SETTING : UNAVAILABLE;
    }

    static MongoFailure of(int code, String message) {
        if (code == DUPLICATE_KEY && OF_ID.matcher(message).find()) {
            return UNAVAILABLE; // two upserts of one new id at once: the second try finds the document and replaces it
        }
        if (MongoCodes.OF_TIME.contains(code)) {
            return UNAVAILABLE;
        }
        if (MongoCodes.OF_SETTING.contains(code)) {
            return SETTING;
        }
        return MongoCodes.OF_DOCUMENT.contains(code) ? REFUSED : UNKNOWN;
    }
}
