/** Tests of what is deployed: the files of {@code docker/} and the unit for systemd. */
package io.furrow.deployment;
