package io.furrow.control.manager;

import java.util.List;

import io.furrow.model.control.CommandResult;
import io.furrow.model.control.RejectedException;

/**
 * Who answers the requests of one manager.
 *
 * @param <C> its commands
 */
public interface CommandHandler<C> {
    /**
     * Grants or refuses; what is refused has changed nothing.
     *
     * @param now epoch ms
     */
    CommandResult answer(C command, long now) throws RejectedException;

    /** Called about once a second, and before the first request. */
    default void passTime(long now) {}

    /** What is to be done about once a second; each step takes effect as a whole or not at all, and none keeps the others up. */
    default List<Runnable> due(long now) {
        return List.of(() -> passTime(now));
    }

    /** What was begun and is too much for one transaction: the next part of each, called ten times a second. */
    default List<Runnable> pending(long now) {
        return List.of();
    }
}
