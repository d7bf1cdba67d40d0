package io.furrow.ingest.mission;

import java.util.Set;

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
    AWAY,
    /** Nothing can be written until somebody changes a setting. */
    SETTING,
    /** The server will never take this document. */
    REFUSED;

    private static final int DUPLICATE_KEY = 11000;

    /** Unreachable, shutting down, not primary, out of time, locks, full disk, no quorum for the write. */
    private static final Set<Integer> AWAY_CODES = Set.of(
            6, 7, 24, 46, 50, 64, 89, 91, 100, 112, 117, 134, 189, 202, 262, 9001, 10107, 11600, 11601, 11602, 13435,
            13436, 14031);

    /** Not authorised, not authenticated, illegal operation, no such command, invalid name or options, a view, quota. */
    private static final Set<Integer> SETTING_CODES = Set.of(13, 18, 20, 59, 67, 72, 73, 115, 166, 8000);

    static MongoFailure of(MongoException failure) {
        boolean away = failure instanceof MongoSocketException
                || failure instanceof MongoTimeoutException
                || failure instanceof MongoNotPrimaryException
                || failure instanceof MongoNodeIsRecoveringException
                || failure instanceof MongoWriteConcernException
                || failure.hasErrorLabel("RetryableWriteError")
                || failure.hasErrorLabel("TransientTransactionError");
        if (away || failure.getCause() instanceof MongoSocketException) {
            return AWAY;
        }
        if (failure instanceof MongoServerException) {
            return of(failure.getCode(), failure.getMessage());
        }
        // The driver's own: it says nothing of any document.
        boolean hopeless = failure instanceof MongoSecurityException
                || failure instanceof MongoIncompatibleDriverException
                || failure instanceof MongoConfigurationException;
        return hopeless ? SETTING : AWAY;
    }

    static MongoFailure of(int code, String message) {
        if (AWAY_CODES.contains(code)) {
            return AWAY;
        }
        if (code == DUPLICATE_KEY && message.contains("_id_")) {
            return AWAY; // two upserts of one new id at once: the second try finds the document and replaces it
        }
        return SETTING_CODES.contains(code) ? SETTING : REFUSED;
    }
}
