C SPDX-License-Identifier: BSD-3-Clause
C
C The second code finds the first zero of the Bessel function J0 by
C bisection. Every value of J0 is a sum over the ranks of ICOMM.
      SUBROUTINE BESSEL(ICOMM, ZERO)
      INTEGER ICOMM, I
      DOUBLE PRECISION ZERO, BELOW, ABOVE, BESJ0R
C     J0 is positive at 2 and negative at 3.
      BELOW = 2D0
      ABOVE = 3D0
      DO 10 I = 1, 45
        ZERO = (BELOW + ABOVE) / 2D0
        IF (BESJ0R(ICOMM, ZERO) .GT. 0D0) THEN
          BELOW = ZERO
        ELSE
          ABOVE = ZERO
        END IF
   10 CONTINUE
      END

C Returns J0(X), which is 1/pi times the integral of cos(X sin t) over t
C from 0 to pi, by the midpoint rule on N intervals that are distributed
C over the ranks of ICOMM. The rule converges faster than any power of
C N, because the integrand is smooth and periodic. Collective.
      DOUBLE PRECISION FUNCTION BESJ0R(ICOMM, X)
      INCLUDE 'mpif.h'
      INTEGER ICOMM, N, I, NSIZE, MYRANK, IERR
      PARAMETER (N = 10000)
      DOUBLE PRECISION X, PI, PART(1), WHOLE(1)
      PARAMETER (PI = 3.14159265358979324D0)
      CALL MPI_COMM_SIZE(ICOMM, NSIZE, IERR)
      CALL MPI_COMM_RANK(ICOMM, MYRANK, IERR)
      PART(1) = 0D0
      DO 10 I = MYRANK + 1, N, NSIZE
        PART(1) = PART(1) + COS(X * SIN(PI * (I - 0.5D0) / N))
   10 CONTINUE
      CALL MPI_ALLREDUCE(PART, WHOLE, 1, MPI_DOUBLE_PRECISION, MPI_SUM,
     &                   ICOMM, IERR)
      BESJ0R = WHOLE(1) / N
      END
