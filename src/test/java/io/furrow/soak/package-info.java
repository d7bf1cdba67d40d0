/** Long runs against the deployed programs: writers of numbered events, and checks of the results. */
package io.furrow.soak;
