package io.furrow.control.alarm;

/** An event in the life of an existing alarm. */
sealed interface AlarmEvent {
    /**
     * The cause was observed again.
     *
     * @param until new end of validity, epoch ms; null if the alarm lasts until it is ended explicitly
     */
    record Repeated(Long until) implements AlarmEvent {}

    /**
     * The current extent of a group alarm.
     *
     * @param inhibitedBy id of the inhibiting alarm; null if none
     */
    record Reported(Cause cause, String inhibitedBy) implements AlarmEvent {}

    /** @param reason why the alarm ended */
    record Ended(String reason) implements AlarmEvent {}

    /**
     * A user closes the alarm.
     *
     * @param user null if not named
     * @param isOver of a group alarm, whether none of its causes was reported lately
     */
    record ManuallyClosed(String user, boolean isOver) implements AlarmEvent {}

    /** @param user null if not named */
    record Acknowledged(String user) implements AlarmEvent {}

    /** @param until end of the mute, epoch ms */
    record Muted(long until) implements AlarmEvent {}

    record Unmuted() implements AlarmEvent {}

    /** Time has passed without any other event. */
    record TimePassed() implements AlarmEvent {}
}
