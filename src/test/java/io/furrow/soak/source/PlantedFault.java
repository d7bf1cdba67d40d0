package io.furrow.soak.source;

/** A fault that a soak can insert to show that its checks detect it. */
enum PlantedFault {
    NONE,
    /** A notification is answered 200 and dropped. */
    LOSE,
    /** A notification is sent to the listener twice but counted once. */
    REPEAT,
    /** A journal is deleted from a disk while its worker is stopped. */
    TAKE_JOURNAL
}
