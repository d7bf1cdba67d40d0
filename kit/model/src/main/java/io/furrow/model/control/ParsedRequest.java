package io.furrow.model.control;

/**
 * A parsed record of a manager's topic.
 *
 * @param <C> the commands of that manager
 */
public sealed interface ParsedRequest<C> {
    /**
     * A valid request.
     *
     * @param requestId null if the request has none
     * @param ifSequence the sequence that what it changes must have; null for any
     * @param dryRun whether it is only answered, and changes nothing
     */
    record Request<C>(String requestId, C command, Long ifSequence, boolean dryRun) implements ParsedRequest<C> {
        public Request(String requestId, C command) {
            this(requestId, command, null, false);
        }
    }

    /**
     * An invalid request or other record.
     *
     * @param requestId null if it cannot be read
     * @param answer without the request's id
     */
    record Refused<C>(String requestId, CommandResult answer) implements ParsedRequest<C> {}

    /** A record that managers ignore: a response, or a record without a value. */
    record Passed<C>() implements ParsedRequest<C> {}
}
