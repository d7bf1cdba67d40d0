package io.furrow.control.manager;

import java.util.List;
import java.util.OptionalLong;

import io.furrow.model.control.CommandResult;
import io.furrow.model.control.RejectedException;

/**
 * Executes the commands of one manager.
 *
 * @param <C> its commands
 */
public interface CommandHandler<C> {
    /**
     * Executes or rejects a command. A rejected command changes nothing.
     *
     * @param now epoch ms
     */
    CommandResult answer(C command, long now) throws RejectedException;

    /** Returns the sequence of what a command changes; empty if it does not exist, or has none. */
    default OptionalLong sequenceOf(C command) {
        return OptionalLong.empty();
    }

    /** Called about once a second, and before the first request. */
    default void passTime(long now) {}

    /** Returns the steps to execute about once a second. Each step is atomic, and its failure does not affect the others. */
    default List<Runnable> due(long now) {
        return List.of(() -> passTime(now));
    }

    /** Returns the next part of each change that is too large for one transaction, called ten times a second. */
    default List<Runnable> pending(long now) {
        return List.of();
    }
}
