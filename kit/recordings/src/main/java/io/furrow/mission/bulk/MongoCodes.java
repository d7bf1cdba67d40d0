package io.furrow.mission.bulk;

import java.util.Set;
import java.util.regex.Pattern;
import java.util.stream.Collectors;

/**
 * Classifies MongoDB's error codes for documents that are upserted by {@code _id}. The names are those of the server's
 * {@code error_codes.yml}. Codes outside of these lists, for instance 1 (InternalError) and 8 (UnknownError), may be
 * caused by the document or by the server.
 */
final class MongoCodes {
    /** If the whole command fails with these, the cause may be its settings or a document. */
    private static final Set<Integer> OF_DOCUMENT_OR_COMMAND = codes("2 BadValue, 9 FailedToParse");

    /** The document can never be stored. */
    static final Set<Integer> OF_DOCUMENT = codes("""
            2 BadValue, 9 FailedToParse, 14 TypeMismatch, 15 Overflow, 16 InvalidLength, 22 InvalidBSON,
            28 PathNotViable, 52 DollarPrefixedFieldName, 53 InvalidIdField, 54 NotSingleValueField, 55 InvalidDBRef,
            56 EmptyFieldName, 57 DottedFieldName, 66 ImmutableField, 116 DocTooLargeForCapped,
            121 DocumentValidationFailure, 171 CannotIndexParallelArrays, 201 CannotBuildIndexKeys, 207 InvalidUUID,
            357 InvalidBSONType, 378 NonConformantBSON, 510 GeoKeyExtractionFailed,
            511 GeoKeyExtractionFailedTimeseries, 10003 CannotGrowDocumentInCappedNamespace, 10334 BSONObjectTooLarge,
            11000 DuplicateKey (of another index than that of _id),
            11001 DuplicateKey (of an update; servers of long ago),
            16755 GeoKeyExtractionFailed (before it had a name), 17280 KeyTooLong,
            17419 DocumentTooLarge (after the update), 17420 DocumentTooLarge (after the update)
            """);

    /** Nothing can be written until a setting, a permission or the server is changed. */
    static final Set<Integer> OF_SETTING = codes("""
            11 UserNotFound, 13 Unauthorized, 18 AuthenticationFailed, 20 IllegalOperation, 31 RoleNotFound,
            59 CommandNotFound, 61 ShardKeyNotFound (sharded by something else than _id), 67 CannotCreateIndex,
            72 InvalidOptions, 73 InvalidNamespace, 79 UnknownReplWriteConcern, 101 OutdatedClient,
            115 CommandNotSupported, 140 InvalidSSLConfiguration, 166 CommandNotSupportedOnView,
            167 OptionNotSupportedOnView, 214 AuthenticationRestrictionUnmet, 227 CannotImplicitlyCreateCollection,
            238 NotImplemented, 242 CannotCreateCollection, 322 APIVersionError, 323 APIStrictError,
            324 APIDeprecationError, 334 MechanismUnavailable, 347 APIMismatchError, 352 UnsupportedOpQueryCommand,
            411 QueryRejectedBySettings, 8000 AtlasError
            """);

    /** Transient: unreachable, busy, not primary, stale shard, out of time, memory or disk, throttled. */
    static final Set<Integer> TRANSIENT = codes("""
            6 HostUnreachable, 7 HostNotFound, 24 LockTimeout, 46 LockBusy, 50 MaxTimeMSExpired, 63 StaleShardVersion,
            64 WriteConcernTimeout, 70 ShardNotFound, 75 WriteConcernLegacyOK, 83 RemoteResultsUnavailable,
            89 NetworkTimeout, 90 CallbackCanceled, 91 ShutdownInProgress, 94 NotYetInitialized, 95 NotSecondary,
            100 UnsatisfiableWriteConcern, 107 LockFailed, 109 ConfigurationInProgress, 112 WriteConflict,
            117 ConflictingOperationInProgress, 133 FailedToSatisfyReadPreference,
            134 ReadConcernMajorityNotAvailableYet, 145 PooledConnectionsDropped, 146 ExceededMemoryLimit,
            149 NoConfigPrimary, 150 StaleEpoch, 172 TransportSessionClosed, 189 PrimarySteppedDown,
            199 ReplicaSetMonitorRemoved, 200 ChunkRangeCleanupPending, 202 NetworkInterfaceExceededTimeLimit,
            203 ShardingStateNotInitialized, 208 TooManyLocks, 211 KeyNotFound, 215 DatabaseDropPending,
            216 ElectionInProgress, 225 TransactionTooOld, 230 DNSHostNotFound, 231 DNSProtocolError,
            239 SnapshotTooOld, 246 SnapshotUnavailable, 249 StaleDbVersion, 250 StaleChunkHistory,
            251 NoSuchTransaction, 261 TooManyLogicalSessions, 262 ExceededTimeLimit, 264 TooManyFilesOpen,
            267 PreparedTransactionInProgress, 272 MigrationConflict, 276 IndexBuildAborted, 279 ClientDisconnect,
            281 TransactionCoordinatorSteppingDown, 282 TransactionCoordinatorReachedAbortDecision,
            285 IndexBuildAlreadyInProgress, 290 TransactionExceededLifetimeLimitSeconds, 303 SplitHorizonChange,
            308 CurrentConfigNotCommittedYet, 310 PeriodicJobIsStopped, 314 ObjectIsBusy, 317 ConnectionPoolExpired,
            319 MovePrimaryInProgress, 333 ServiceExecutorInShutdown, 338 ReshardCollectionInProgress,
            342 ReshardingCriticalSectionTimeout, 343 ShardCannotRefreshDueToLocksHeld,
            355 InterruptedDueToStorageChange, 358 InternalTransactionNotSupported,
            363 RetryableTransactionInProgress, 365 TemporarilyUnavailable, 371 UserWritesBlocked,
            384 ConnectionError, 388 TransactionTooLargeForCache, 391 ReauthenticationRequired, 398 StreamTerminated,
            402 ResourceExhausted, 406 MigrationBlockingOperationCoordinatorCleaningUp,
            407 PooledConnectionAcquisitionExceededTimeLimit, 412 UpdatesStillPending, 414 AddOrRemoveShardInProgress,
            433 AdmissionQueueOverflow, 449 RateLimitExceeded, 450 PooledConnectionAcquisitionRejected,
            453 InterruptedDueToReshardingCriticalSection, 462 IngressRequestRateLimitExceeded,
            471 InterruptedDueToAddShard, 473 InterruptedDueToOverload, 488 PrimaryOnlyServiceInitializing,
            506 NodeInStepDownPeriod, 507 ReplicaSetWritesBlocked, 509 TooManyOpenTransactions,
            514 LightweightStepdownConflict, 515 ConnectionClosedByPeer, 516 ConnectionEstablishmentTimeout,
            521 QueryMemoryLimitExceeded, 522 RetryBackoff, 526 ChameleonRejected, 9001 SocketException,
            10058 LegacyNotPrimary, 10107 NotWritablePrimary, 11600 InterruptedAtShutdown, 11601 Interrupted,
            11602 InterruptedDueToReplStateChange, 12586 BackgroundOperationInProgressForDatabase,
            12587 BackgroundOperationInProgressForNamespace, 13388 StaleConfig, 13435 NotPrimaryNoSecondaryOk,
            13436 NotPrimaryOrSecondary, 14031 OutOfDiskSpace, 16500 RequestRateTooLarge (Cosmos DB),
            46841 ClientMarkedKilled, 50915 BackupCursorOpenConflictWithCheckpoint, 56846 ConfigServerUnreachable,
            91331 RetriableRemoteCommandFailure, 10045600 InterruptedDueToFCVChange
            """);

    private MongoCodes() {}

    private static Set<Integer> codes(String list) {
        return Pattern.compile(",")
                .splitAsStream(list)
                .map(each -> Integer.valueOf(each.strip().split(" ")[0]))
                .collect(Collectors.toUnmodifiableSet());
    }

    /** Returns whether the failure of a whole command may be caused by its settings or by a document. */
    static boolean isAmbiguousForCommand(int code) {
        return OF_DOCUMENT_OR_COMMAND.contains(code);
    }
}
