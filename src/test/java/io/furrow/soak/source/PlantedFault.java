package io.furrow.soak.source;

/** What a soak can be told to do wrong, to show that its checks see it. */
enum PlantedFault {
    NONE,
    /** A notification is answered 200 and goes nowhere. */
    LOSE,
    /** A notification goes to the listener twice, and is known of as one. */
    REPEAT,
    /** A journal is taken from a disk while its worker is away. */
    TAKE_JOURNAL
}
