/** Tests of the files of {@code docker/} and of the systemd unit. */
package io.furrow.deployment;
