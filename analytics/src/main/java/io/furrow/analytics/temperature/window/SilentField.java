package io.furrow.analytics.temperature.window;

import io.furrow.analytics.temperature.InputScope;

/**
 * What is known of a field whose next window may be empty.
 *
 * @param heard start of the newest window with a reading, epoch ms
 * @param next start of the window that comes next, epoch ms
 */
public record SilentField(String field, InputScope scope, long heard, long next) {
    SilentField heard(long start, long slide) {
        return new SilentField(field, scope, Math.max(heard, start), Math.max(next, start + slide));
    }

    SilentField after(long slide) {
        return new SilentField(field, scope, heard, next + slide);
    }
}
