/**
 * The job {@code replay}: plays stored missions back on topics of their own.
 *
 * <p><b>In</b>: {@code service.replays}, recordings of {@code kit/recordings}.
 *
 * <p><b>Out</b>: {@code data.<mission>.replay.<id8>}, {@code service.replays.status}.
 *
 * <p><b>Must not know</b>: who asks for replays, and which analytics read them.
 */
package io.furrow.replay;
