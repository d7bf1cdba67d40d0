package io.furrow.control.alarm;

/** What happens to an alarm that there is. */
public sealed interface AlarmEvent {
    /**
     * The cause was seen again.
     *
     * @param until how long it is so from now on, epoch ms; null until something says that it is over
     */
    record Repeated(Long until) implements AlarmEvent {}

    /**
     * How it is with the many that a group alarm stands for.
     *
     * @param inhibitedBy id of the alarm that says more; null where none does
     */
    record Reported(Cause cause, String inhibitedBy) implements AlarmEvent {}

    /** @param reason why it is over */
    record Ended(String reason) implements AlarmEvent {}

    /** A user asks to close it. @param user null where none is named */
    record Dismissed(String user) implements AlarmEvent {}

    /** @param user null where none is named */
    record Acknowledged(String user) implements AlarmEvent {}

    /** @param until end of the mute, epoch ms */
    record Muted(long until) implements AlarmEvent {}

    record Unmuted() implements AlarmEvent {}

    /** Nothing but time. */
    record TimePassed() implements AlarmEvent {}
}
