package io.furrow.model.control;

/**
 * What a record on a manager's topic is.
 *
 * @param <C> the commands of that manager
 */
public sealed interface ParsedRequest<C> {
    /** @param requestId null if the request has none */
    record Request<C>(String requestId, C command) implements ParsedRequest<C> {}

    /**
     * A request that cannot be understood, or what is not a message at all.
     *
     * @param requestId null if none can be read
     * @param answer without the request's id
     */
    record Refused<C>(String requestId, CommandResult answer) implements ParsedRequest<C> {}

    /** Nothing that a manager acts on: its own responses, and records without a value. */
    record Passed<C>() implements ParsedRequest<C> {}
}
